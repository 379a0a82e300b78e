#include "surface_tension/surface_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

// Against the work of the forces while the points go from where they are a little earlier to a little later, on a drop,
// a chain and a pair.
TEST(TurningForces, MakeThePowerOfTheForcesOnThePoints) {
  Positions pair_and_drop = ring_disc(6);
  pair_and_drop.push_back({30.0 * spacing, 0.0});
  pair_and_drop.push_back({31.0 * spacing, 0.3 * spacing});
  for (const Positions& positions : {pair_and_drop, rectangle(5, 1), rectangle(5, 3)}) {
    const SurfaceCurves curves = curves_of(positions);
    const Positions nodes = node_positions(curves, positions);
    const std::size_t size = nodes.size();
    Positions velocities, forces, turning(size), earlier, later, before(size), after(size);
    const double step = 1e-5 * spacing;
    for (std::size_t k = 0; k < size; ++k) {
      // One velocity a particle, whatever its nodes; neither a translation nor a rotation.
      const auto id = static_cast<double>(curves.nodes[k].particle);
      velocities.push_back({std::sin(3.0 * id) + 0.2, std::cos(5.0 * id) - 0.4});
      forces.push_back({std::cos(2.0 * static_cast<double>(k)), std::sin(7.0 * static_cast<double>(k))});
      earlier.push_back(nodes[k] - step * velocities[k]);
      later.push_back(nodes[k] + step * velocities[k]);
    }
    surface_points(curves, earlier, spacing, before);
    surface_points(curves, later, spacing, after);
    std::vector<double> chords(size);
    Positions points(size), points_alone(size);
    surface_points(curves, nodes, spacing, points, chords);
    surface_points(curves, nodes, spacing, points_alone);
    EXPECT_EQ(points, points_alone);
    turning_forces(curves, nodes, chords, spacing, forces, turning);
    double power = 0, power_without = 0, expected = 0;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const SurfaceCurves::Range curve = curves.curve(c);
      for (std::size_t k = curve.first; k < curve.last; ++k) {
        power_without += dot(velocities[k], forces[k]);
        power += dot(velocities[k], forces[k] + turning[curve.previous(k)] - turning[curve.next(k)]);
        expected += dot(forces[k], after[k] - before[k]) / (2.0 * step);
      }
    }
    EXPECT_NEAR(power, expected, 1e-6 * static_cast<double>(size));
    EXPECT_GT(std::abs(power_without - expected), 0.01);  // or the turning would not matter
  }
}

}  // namespace
}  // namespace sphdrop
