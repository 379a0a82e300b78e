#include "surface_tension/surface_points.hpp"

#include <gtest/gtest.h>

#include "drops.hpp"

namespace sphdrop {
namespace {

using namespace test;

Positions points_of(const Positions& positions) {
  const SurfaceCurves curves = curves_of(positions);
  Positions points(curves.nodes.size());
  surface_points(curves, node_positions(curves, positions), spacing, points);
  return points;
}

TEST(SurfacePoints, OfARoundDropLieOnItsOutline) {
  for (const Vector point : points_of(ring_disc(20))) EXPECT_NEAR(length(point), 20.0 * spacing, 1e-9 * spacing);
}

TEST(SurfacePoints, OfABlockLieHalfASpacingOutside) {
  const Positions positions = rectangle(8, 8);
  const SurfaceCurves curves = curves_of(positions);
  const Positions nodes = node_positions(curves, positions);
  const Positions points = points_of(positions);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector shift = (points[k] - nodes[k]) / spacing;
    EXPECT_NEAR(length(shift), 0.5, 1e-12);
    const Vector from_centre = nodes[k] - Vector{3.5 * spacing, 3.5 * spacing};
    EXPECT_GT(dot(shift, from_centre), 0.0);
    const bool on_side = curves.nodes[k].particle > 0 && curves.nodes[k].particle < 7;  // the side x = 0, no corners
    if (on_side) {
      EXPECT_NEAR(shift.x, -0.5, 1e-12);
    }
  }
}

TEST(SurfacePoints, OfAChainLieOnBothSidesAndBeyondItsEnds) {
  const Positions points = points_of(rectangle(5, 1));
  const Positions expected = {{-0.5, 0}, {1, -0.5}, {2, -0.5}, {3, -0.5}, {4.5, 0}, {3, 0.5}, {2, 0.5}, {1, 0.5}};
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(points[k].x / spacing, expected[k].x, 1e-12) << k;
    EXPECT_NEAR(points[k].y / spacing, expected[k].y, 1e-12) << k;
  }
}

TEST(SurfacePoints, OfAHoleLieInsideIt) {
  const Positions positions = lattice(15, 0.5, [](double x, double y) {
    const double squared = x * x + y * y;
    return squared < 200 && squared > 36;
  });
  const SurfaceCurves curves = curves_of(positions);
  const Positions nodes = node_positions(curves, positions);
  const Positions points = points_of(positions);
  ASSERT_EQ(curves.size(), 2U);
  for (std::size_t k = curves.curve(1).first; k < curves.curve(1).last; ++k)
    EXPECT_LT(length(points[k]), length(nodes[k]) - 0.3 * spacing);
}

TEST(SurfacePoints, OfPairsAndIsolatedParticlesAreFinite) {
  const Positions points = points_of({{0.0, 0.0}, {20.0 * spacing, 0.0}, {21.0 * spacing, 0.0}});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(length(points[0]), 0.5 * spacing, 1e-12 * spacing);
  EXPECT_NEAR(points[1].x, 19.5 * spacing, 1e-12 * spacing);
  EXPECT_NEAR(points[2].x, 21.5 * spacing, 1e-12 * spacing);
}

}  // namespace
}  // namespace sphdrop
