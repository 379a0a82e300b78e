#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fluid/particle_shifting.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::smoothing_length;
using test::spacing;

const ShiftingParameters parameters{CubicSpline(smoothing_length), smoothing_length, spacing};

std::vector<Vector> gradients(const std::vector<Vector>& positions) {
  FluidParticles fluid;
  std::vector<test::FluidSample> sample;
  sample.reserve(positions.size());
  for (const Vector& p : positions) sample.push_back({p, {}});
  test::fill(fluid, sample, test::first_ids(sample.size()));
  const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0],
                                            2 * smoothing_length + 0.4 * spacing);
  std::vector<double> x(fluid.size()), y(fluid.size());
  concentration_gradients(fluid, list, parameters, x, y);
  std::vector<Vector> result;
  for (std::size_t row = 0; row < x.size(); ++row) result.push_back({x[row], y[row]});
  return result;
}

TEST(ConcentrationGradient, IsThePrintedSum) {
  test::RandomNumbers random(80);
  std::vector<Vector> positions = test::lattice(9, 9, spacing);
  test::perturb(positions, 0.3 * spacing, random);
  const std::vector<Vector> found = gradients(positions);
  const CubicSpline kernel(smoothing_length);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Vector expected;
    for (std::size_t j = 0; j < positions.size(); ++j) {
      if (i == j) continue;
      const Vector x = positions[i] - positions[j];
      const double nearness = kernel.value(length(x)) / kernel.value(spacing);
      expected += spacing * spacing * (1 + 0.2 * std::pow(nearness, 4)) * kernel.slope(length(x)) / length(x) * x;
    }
    EXPECT_NEAR(length(found[i] - expected), 0.0, 1e-12 / spacing) << i;
  }
}

TEST(ConcentrationGradient, VanishesInALatticeAndPointsInwardsAtItsSide) {
  const std::vector<Vector> found = gradients(test::lattice(11, 11, spacing));
  EXPECT_LE(length(found[5 * 11 + 5]), 1e-12 / spacing);
  EXPECT_GT(found[5].x, 0.1 / spacing);  // of the leftmost column
  EXPECT_NEAR(found[5].y, 0.0, 1e-12 / spacing);
}

// Away from the crowd, at most 0.05 d, and in proportion to speed and time below that.
TEST(Shift, GoesDownTheGradientAndIsLimited) {
  const Vector gradient = Vector{3, -4} / smoothing_length;
  const Vector small = shift(gradient, 0.5, 1e-9, parameters, 0, 0, 0);
  EXPECT_NEAR(small.x, -2 * 0.5 * 1e-9 * 3, 1e-24);
  EXPECT_NEAR(small.y, 2 * 0.5 * 1e-9 * 4, 1e-24);
  const Vector large = shift(gradient, 0.5, 1.0, parameters, 0, 0, 0);
  EXPECT_NEAR(large.x, -0.05 * spacing * 0.6, 1e-18);
  EXPECT_NEAR(large.y, 0.05 * spacing * 0.8, 1e-18);
  EXPECT_EQ(shift({}, 0.5, 1.0, parameters, 0, 0, 0), Vector{});
}

TEST(Shift, KeepsWhatIsAlongTheSurface) {
  OrientationSums sums;
  sums.add({0.6, 0.8}, 0.3);
  sums.add({-0.6, -0.8}, 0.1);  // either sign: both sides of a film
  const OrientationSums m = normalised(sums);
  const Vector gradient = Vector{-1, -3} / smoothing_length;
  const Vector free = shift(gradient, 1, 1e-9, parameters, 0, 0, 0);
  const Vector bound = shift(gradient, 1, 1e-9, parameters, m.xx, m.xy, m.yy);
  EXPECT_NEAR(dot(bound, {0.6, 0.8}), 0.0, 1e-15 * length(free));
  EXPECT_NEAR(dot(bound, {-0.8, 0.6}), dot(free, {-0.8, 0.6}), 1e-15 * length(free));
}

// A tip has normals in all directions: no way is along the surface.
TEST(Shift, StandsStillWhereNormalsPointEverywhere) {
  OrientationSums sums;
  for (const Vector n : {Vector{1, 0}, Vector{0, 1}, Vector{-0.6, 0.8}, Vector{0.8, 0.6}}) sums.add(n, 0.25);
  const OrientationSums m = normalised(sums);
  EXPECT_NEAR(length(shift(Vector{1e4, 2e4}, 1, 1e-9, parameters, m.xx, m.xy, m.yy)), 0.0, 1e-24);
}

TEST(Orientation, OfNothingIsZero) {
  const OrientationSums m = normalised({});
  EXPECT_EQ(m.xx, 0.0);
  EXPECT_EQ(m.xy, 0.0);
  EXPECT_EQ(m.yy, 0.0);
}

}  // namespace
}  // namespace sphdrop
