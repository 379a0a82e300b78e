#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sph/cell_grid.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

struct Points {
  std::vector<double> x, y;
  void add(Vector p) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
};

/// How often the grid names each point for `place`.
std::vector<int> visits(const CellGrid& grid, const Points& points, Vector place) {
  std::vector<int> count(points.x.size(), 0);
  grid.for_each_near(place, [&](std::int32_t k) { ++count.at(static_cast<std::size_t>(k)); });
  return count;
}

void expect_all_near_found_once(const CellGrid& grid, const Points& points, Vector place, double reach) {
  const std::vector<int> count = visits(grid, points, place);
  for (std::size_t k = 0; k < count.size(); ++k) {
    EXPECT_LE(count[k], 1);
    if (length(Vector{points.x[k], points.y[k]} - place) < reach) {
      EXPECT_EQ(count[k], 1) << "point " << k << " at " << points.x[k] << ", " << points.y[k] << " from " << place.x
                             << ", " << place.y;
    }
  }
}

TEST(CellGrid, FindsAllPointsWithinReachInsideAndOutside) {
  test::RandomNumbers random(5);
  Points points;
  for (int k = 0; k < 400; ++k) points.add(random.in_box({-3, 7}, {5, 10}));
  for (const double reach : {0.1, 0.5, 1.7, 20.0}) {
    const CellGrid grid(points.x, points.y, reach);
    for (std::size_t k = 0; k < points.x.size(); ++k)
      expect_all_near_found_once(grid, points, {points.x[k], points.y[k]}, reach);
    for (int k = 0; k < 400; ++k) expect_all_near_found_once(grid, points, random.in_box({-6, 4}, {8, 13}), reach);
  }
}

TEST(CellGrid, FindsPointsOnCellEdges) {
  Points points;
  for (int ix = 0; ix < 12; ++ix)
    for (int iy = 0; iy < 12; ++iy) points.add({0.1 * ix, 0.1 * iy});
  for (const double reach : {0.1, 0.2, 0.3}) {
    const CellGrid grid(points.x, points.y, reach);
    for (std::size_t k = 0; k < points.x.size(); ++k)
      expect_all_near_found_once(grid, points, {points.x[k], points.y[k]}, reach);
  }
}

TEST(CellGrid, LooksAtFewPointsOnly) {
  Points points;
  for (int ix = 0; ix < 100; ++ix)
    for (int iy = 0; iy < 100; ++iy) points.add({ix + 0.5, iy + 0.5});
  const CellGrid grid(points.x, points.y, 2.0);
  int looked_at = 0;
  for (const int count : visits(grid, points, {50, 50})) looked_at += count;
  EXPECT_EQ(looked_at, 36);  // nine cells of 2 x 2
}

TEST(CellGrid, StraysFarAwayCostNeitherMemoryNorNeighbours) {
  test::RandomNumbers random(6);
  Points points;
  for (int k = 0; k < 100; ++k) points.add(random.in_box({0, 0}, {10, 10}));
  points.add({1e9, -1e9});
  points.add({-1e9, 1e9});
  const CellGrid grid(points.x, points.y, 1.0);
  for (std::size_t k = 0; k < points.x.size(); ++k)
    expect_all_near_found_once(grid, points, {points.x[k], points.y[k]}, 1.0);
  // A stray's nine cells hold the stray alone.
  int looked_at = 0;
  for (const int count : visits(grid, points, {1e9, -1e9})) looked_at += count;
  EXPECT_EQ(looked_at, 1);
}

TEST(CellGrid, EmptyFindsNothing) {
  const CellGrid grid({}, {}, 1.0);
  grid.for_each_near({0, 0}, [](std::int32_t) { ADD_FAILURE(); });
}

TEST(CellGrid, OnePointIsFoundFromAllAround) {
  Points points;
  points.add({2, 3});
  const CellGrid grid(points.x, points.y, 0.5);
  for (int k = 0; k < 64; ++k) {
    const double angle = k * 0.1;
    expect_all_near_found_once(grid, points, {2 + 0.499 * std::cos(angle), 3 + 0.499 * std::sin(angle)}, 0.5);
  }
  for (const Vector far : {Vector{4, 3}, Vector{2, 5}, Vector{0, 3}, Vector{2, 1}})
    EXPECT_EQ(visits(grid, points, far)[0], 0);
}

TEST(CellGrid, PlacesFarOutsideFindNothing) {
  Points points;
  for (int k = 0; k < 20; ++k) points.add({0.1 * k, 0.05 * k});
  const CellGrid grid(points.x, points.y, 0.2);
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double away : {1e3, 1e12, 1e300, infinity})
    for (const Vector place : {Vector{away, 0}, Vector{-away, 0}, Vector{0, away}, Vector{0, -away}})
      for (const int count : visits(grid, points, place)) EXPECT_EQ(count, 0);
  for (const int count : visits(grid, points, {nan, 0})) EXPECT_EQ(count, 0);
  for (const int count : visits(grid, points, {0, nan})) EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace sphdrop
