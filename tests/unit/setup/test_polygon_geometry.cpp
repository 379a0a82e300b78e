#include <gtest/gtest.h>

#include <cmath>

#include "setup/polygon_geometry.hpp"

namespace sphdrop {
namespace {

// A notched plate, counterclockwise: 8 wide, 4 high, a notch of 2 x 3 from above.
const std::vector<Vector> notched{{0, 0}, {8, 0}, {8, 4}, {5, 4}, {5, 1}, {3, 1}, {3, 4}, {0, 4}};
const std::vector<Vector> triangle{{0, 0}, {6, 0}, {0, 3}};

TEST(PolygonGeometry, TurnsTheCornersCounterclockwise) {
  const Points clockwise{{0, 0}, {0, 2e-3}, {1e-3, 0}};
  const std::vector<Vector> polygon = counterclockwise_polygon(clockwise, 1e-3);
  EXPECT_DOUBLE_EQ(signed_area(polygon), 1.0);
  EXPECT_DOUBLE_EQ(signed_area(counterclockwise_polygon({{1e-3, 0}, {0, 2e-3}, {0, 0}}, 1e-3)), 1.0);
}

TEST(PolygonGeometry, KnowsInsideFromOutside) {
  EXPECT_TRUE(contains(notched, {1, 3}));
  EXPECT_TRUE(contains(notched, {4, 0.5}));
  EXPECT_FALSE(contains(notched, {4, 2}));  // in the notch
  EXPECT_FALSE(contains(notched, {9, 1}));
  EXPECT_FALSE(contains(notched, {-1, 4}));
}

// Of a right triangle of legs a, b: area ab/2, centroid (a/3, b/3), integral of x^2 = a^3 b/12.
TEST(PolygonGeometry, HasTheMomentsOfATriangle) {
  const PlaneMoments m = moments_of(triangle, {0, 0});
  EXPECT_DOUBLE_EQ(m.area, 9.0);
  EXPECT_DOUBLE_EQ(m.first_x, 18.0);
  EXPECT_DOUBLE_EQ(m.first_y, 9.0);
  EXPECT_DOUBLE_EQ(m.second_x, 216.0 * 3 / 12);
  EXPECT_DOUBLE_EQ(m.second_y, 27.0 * 6 / 12);
  const PlaneMoments moved = moments_about(m, 2, -1), direct = moments_of(triangle, {2, -1});
  EXPECT_NEAR(moved.first_x, direct.first_x, 1e-12);
  EXPECT_NEAR(moved.first_y, direct.first_y, 1e-12);
  EXPECT_NEAR(moved.second_x, direct.second_x, 1e-12);
  EXPECT_NEAR(moved.second_y, direct.second_y, 1e-12);
}

TEST(PolygonGeometry, CutsIntoPartsThatAddUp) {
  PlaneMoments sum;
  std::vector<Vector> strip, part;
  for (int column = -1; column < 9; ++column)
    for (int row = -1; row < 5; ++row) {
      clip_in_x(notched, column, column + 1, strip);
      clip_in_y(strip, row, row + 1, part);
      sum += moments_of(part, {0, 0});
    }
  const PlaneMoments whole = moments_of(notched, {0, 0});
  EXPECT_NEAR(sum.area, 26.0, 1e-12);
  EXPECT_NEAR(whole.area, 26.0, 1e-12);
  EXPECT_NEAR(sum.second_x, whole.second_x, 1e-10);
  EXPECT_NEAR(sum.second_y, whole.second_y, 1e-10);
  // Cut through the notch it is two pieces, joined by a border without area.
  clip_in_y(notched, 2, 3, part);
  EXPECT_NEAR(moments_of(part, {0, 0}).area, 6.0, 1e-12);
}

TEST(PolygonGeometry, MovesSidesInwards) {
  const std::vector<Vector> inset = inset_polygon(notched, 0.5);
  ASSERT_EQ(inset.size(), 8U);
  EXPECT_NEAR(signed_area(inset), 7 * 3 - 3 * 3 + 0, 1e-12);  // the notch grows to 3 x 3 of what is left
  for (const Vector& place : subdivided(inset, 0.3))
    EXPECT_NEAR(distance_to_border(notched, place), 0.5, 0.5 * (std::sqrt(2.0) - 1) + 1e-12);
  const std::vector<Vector> small = inset_polygon(triangle, 0.25);
  for (const Vector& place : subdivided(small, 0.3)) {
    EXPECT_NEAR(distance_to_border(triangle, place), 0.25, 1e-12);
    EXPECT_TRUE(contains(triangle, place));
  }
}

TEST(PolygonGeometry, LeavesOutSidesThatVanish) {
  // A blunt tip of 0.4 on a wedge: moved by 1 it is gone, and the sides meet in a point.
  const std::vector<Vector> wedge{{0, -2}, {10, -0.2}, {10, 0.2}, {0, 2}};
  const std::vector<Vector> inset = inset_polygon(wedge, 1.0);
  ASSERT_EQ(inset.size(), 3U);
  for (const Vector& place : subdivided(inset, 0.3)) EXPECT_NEAR(distance_to_border(wedge, place), 1.0, 1e-12);
  EXPECT_TRUE(inset_polygon(wedge, 2.5).empty());
}

TEST(PolygonGeometry, DividesSidesEvenly) {
  const std::vector<Vector> places = subdivided(triangle, 1.0);
  EXPECT_EQ(places.size(), 6U + 7U + 3U);  // the slanting side is 6.7 long
  for (std::size_t k = 0; k < places.size(); ++k)
    EXPECT_LE(length(places[(k + 1) % places.size()] - places[k]), 1.0 + 1e-12);
}

}  // namespace
}  // namespace sphdrop
