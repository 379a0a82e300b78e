#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fluid/particle_shifting.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::smoothing_length;
using test::spacing;

const ShiftingParameters parameters{CubicSpline(smoothing_length), smoothing_length, spacing};

struct Found {
  std::vector<Vector> gradients;
  std::vector<double> concentrations;
};

Found find(const std::vector<Vector>& positions) {
  FluidParticles fluid;
  std::vector<test::FluidSample> sample;
  sample.reserve(positions.size());
  for (const Vector& p : positions) sample.push_back({p, {}});
  test::fill(fluid, sample, test::first_ids(sample.size()));
  const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0],
                                            2 * smoothing_length + 0.4 * spacing);
  std::vector<double> x(fluid.size()), y(fluid.size()), concentration(fluid.size());
  concentration_gradients(fluid, list, parameters, x, y, concentration);
  Found result;
  for (std::size_t row = 0; row < x.size(); ++row) result.gradients.push_back({x[row], y[row]});
  result.concentrations = concentration;
  return result;
}

// Crowded, as dense as at rest, and sparse: all of the gradient, some, and what keeps pairs apart alone.
TEST(ConcentrationGradient, IsThePrintedSum) {
  const CubicSpline kernel(smoothing_length);
  for (const double stretch : {0.95, 0.99, 1.0, 1.1}) {
    test::RandomNumbers random(80);
    std::vector<Vector> positions = test::lattice(9, 9, stretch * spacing);
    test::perturb(positions, 0.2 * spacing, random);
    const Found found = find(positions);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      Vector gradient, near;
      double concentration = spacing * spacing * kernel.value(0.0);
      for (std::size_t j = 0; j < positions.size(); ++j) {
        if (i == j) continue;
        const Vector x = positions[i] - positions[j];
        const Vector slope = spacing * spacing * kernel.slope(length(x)) / length(x) * x;
        concentration += spacing * spacing * kernel.value(length(x));
        gradient += slope;
        near += std::max(0.0, std::pow(kernel.value(length(x)) / kernel.value(spacing), 4) - 3.0) * slope;
      }
      const double crowding = std::min(1.0, std::max(0.0, (concentration - 1.0) / 0.05));
      EXPECT_NEAR(length(found.gradients[i] - (crowding * gradient + near)), 0.0, 1e-11 / spacing) << i;
      EXPECT_NEAR(found.concentrations[i], concentration, 1e-12) << i;
    }
  }
}

TEST(ConcentrationGradient, VanishesInALatticeAndAtItsSideAndPointsToWhatIsTooNear) {
  std::vector<Vector> positions = test::lattice(11, 11, spacing);
  Found found = find(positions);
  EXPECT_NEAR(found.concentrations[5 * 11 + 5], 1.0, 0.01);
  for (const Vector& gradient : found.gradients) EXPECT_LE(length(gradient), 1e-12 / spacing);
  positions[5 * 11 + 5].x += 0.4 * spacing;
  found = find(positions);
  const Vector pushed = found.gradients[5 * 11 + 5], neighbour = found.gradients[6 * 11 + 5];
  const double side = positions[6 * 11 + 5].x > positions[5 * 11 + 5].x ? 1.0 : -1.0;
  EXPECT_GT(std::abs(pushed.x), 0.1 / spacing);
  EXPECT_LT(neighbour.x * side * pushed.x * side, 0.0);  // the two move apart
}

// A crowd spreads, a void is not filled.
TEST(ConcentrationGradient, OfAVoidIsNone) {
  std::vector<Vector> positions = test::lattice(11, 11, spacing);
  positions.erase(positions.begin() + 5 * 11 + 5);
  for (const Vector& gradient : find(positions).gradients) EXPECT_LE(length(gradient), 1e-12 / spacing);
}

TEST(ReturnedDensity, TakesOffWhereParticlesAreSparseAndAddsWhereTheyAreCrowded) {
  const double duration = 0.1 * 10 * smoothing_length / 2.0;  // a tenth of the way at 2 m/s
  EXPECT_EQ(returned_density(1.019, 2.0, duration, parameters), 0.0);
  EXPECT_EQ(returned_density(0.981, 2.0, duration, parameters), 0.0);
  EXPECT_NEAR(returned_density(1.05, 2.0, duration, parameters), 0.03 * 0.1, 1e-15);
  EXPECT_NEAR(returned_density(0.95, 2.0, duration, parameters), -0.03 * 0.1, 1e-15);
  EXPECT_NEAR(returned_density(0.5, 2.0, duration, parameters), -0.05 * 0.1, 1e-15);
  EXPECT_NEAR(returned_density(0.5, 2.0, 1.0, parameters), -0.05, 1e-15);
  EXPECT_EQ(returned_density(0.5, 0.0, duration, parameters), 0.0);
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
