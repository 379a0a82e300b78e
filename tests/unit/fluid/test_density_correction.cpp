#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fluid/density_correction.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::spacing;

constexpr CubicSpline kernel(test::smoothing_length);
constexpr double reach = 2 * test::smoothing_length + 0.4 * spacing;

std::vector<double> corrected(FluidParticles& fluid) {
  const auto rows = static_cast<std::int32_t>(fluid.size());
  const SlicedNeighbours list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, {0, rows}, reach);
  std::vector<double> result(fluid.size() + column_padding, -1.0);
  moving_least_squares_densities(fluid, list, kernel, spacing, result);
  return result;
}

/// rho(x, y), changing by some per cent from one particle to the next: far more than any run shows.
double linear_field(Vector p) {
  return 1000.0 * (1.0 + 0.03 * p.x / spacing - 0.05 * p.y / spacing);
}

void place(FluidParticles& fluid, const std::vector<Vector>& positions, double (*density)(Vector)) {
  test::RandomNumbers random(30);
  std::vector<test::FluidSample> sample;
  sample.reserve(positions.size());
  for (const Vector& p : positions)
    sample.push_back({p, {}, density(p), density(p) * spacing * spacing * random.between(0.7, 1.3)});
  test::fill(fluid, sample, test::first_ids(sample.size()));
}

void expect_reproduced(FluidParticles& fluid, double (*density)(Vector), double tolerance) {
  const std::vector<double> result = corrected(fluid);
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    const double exact = density(fluid.position.at(row));
    EXPECT_NEAR(result[row], exact, tolerance * exact) << "row " << row;
  }
}

TEST(DensityCorrection, ReproducesALinearFieldOnALatticeWithItsSidesAndCorners) {
  FluidParticles fluid;
  place(fluid, test::lattice(9, 12, spacing), linear_field);
  expect_reproduced(fluid, linear_field, 1e-12);
}

TEST(DensityCorrection, ReproducesALinearFieldOnADisorderedDropWithUnevenVolumes) {
  test::RandomNumbers random(31);
  std::vector<Vector> lattice = test::lattice(21, 21, spacing), drop;
  test::perturb(lattice, 0.2 * spacing, random);
  for (const Vector& p : lattice)
    if (length(p - Vector{10 * spacing, 10 * spacing}) < 9 * spacing) drop.push_back(p);
  ASSERT_GT(drop.size(), 200u);
  FluidParticles fluid;
  place(fluid, drop, linear_field);
  expect_reproduced(fluid, linear_field, 1e-12);
}

TEST(DensityCorrection, ReproducesAConstantFieldInAStripOneParticleThick) {
  std::vector<Vector> line;
  line.reserve(20);
  for (int k = 0; k < 20; ++k) line.push_back({k * spacing, 2 * k * spacing * 1e-9});
  FluidParticles fluid;
  place(fluid, line, [](Vector) { return 997.0; });
  expect_reproduced(
      fluid, [](Vector) { return 997.0; }, 1e-13);
}

// Shepard's sum by hand: m_j W_j over V_j W_j.
TEST(DensityCorrection, FallsBackToOrderZeroOnALine) {
  for (const Vector along : {Vector{1, 0}, Vector{0, 1}, Vector{0.6, 0.8}}) {
    std::vector<Vector> line;
    line.reserve(9);
    for (int k = 0; k < 9; ++k) line.push_back(k * spacing * along);
    FluidParticles fluid;
    place(fluid, line, linear_field);
    const std::vector<double> result = corrected(fluid);
    for (std::size_t i = 0; i < line.size(); ++i) {
      double weighted_mass = 0, weighted_volume = 0;
      for (std::size_t j = 0; j < line.size(); ++j) {
        const double w = kernel.value(length(line[i] - line[j]));
        weighted_mass += fluid.mass[j] * w;
        weighted_volume += fluid.mass[j] / fluid.density[j] * w;
      }
      EXPECT_NEAR(result[i], weighted_mass / weighted_volume, 1e-10) << i;
      // It is a mean of the neighbours, not the linear fit, wherever it is lopsided.
      EXPECT_LT(result[i], 1.5 * 1000) << i;
      EXPECT_GT(result[i], 0.5 * 1000) << i;
    }
    EXPECT_GT(std::abs(result[0] / linear_field(line[0]) - 1), 1e-3);
  }
}

TEST(DensityCorrection, TwoParticlesTakeAWeightedMean) {
  FluidParticles fluid;
  place(fluid, {{0, 0}, {spacing, 0}}, linear_field);
  const std::vector<double> result = corrected(fluid);
  const double v0 = fluid.mass[0] / fluid.density[0], v1 = fluid.mass[1] / fluid.density[1];
  const double near = kernel.value(0.0), far = kernel.value(spacing);
  EXPECT_NEAR(result[0], (fluid.mass[0] * near + fluid.mass[1] * far) / (v0 * near + v1 * far), 1e-10);
  EXPECT_NEAR(result[1], (fluid.mass[1] * near + fluid.mass[0] * far) / (v1 * near + v0 * far), 1e-10);
}

TEST(DensityCorrection, LeavesALoneParticleExactlyAsItIs) {
  FluidParticles fluid;
  // The second is within the list's reach but out of the kernel's.
  place(fluid, {{0, 0}, {2.5 * spacing, 0}, {100 * spacing, 3 * spacing}}, linear_field);
  const double before[] = {fluid.density[0], fluid.density[1], fluid.density[2]};
  const std::vector<double> result = corrected(fluid);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(result[row], before[row]);
    EXPECT_EQ(fluid.density[row], before[row]);
  }
}

TEST(DensityCorrection, WritesTheListedRowsOnly) {
  FluidParticles fluid;
  place(fluid, test::lattice(5, 5, spacing), linear_field);
  const SlicedNeighbours list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, {3, 13}, reach);
  std::vector<double> result(fluid.size(), -1.0);
  moving_least_squares_densities(fluid, list, kernel, spacing, result);
  for (std::size_t row = 0; row < result.size(); ++row) EXPECT_EQ(result[row] == -1.0, row < 3 || row >= 13) << row;
}

// One particle at the origin and neighbours on the axes, volumes and weights chosen: A is diagonal.
TEST(MovingLeastSquaresDensity, SolvesForTheValueAtTheParticle) {
  MovingLeastSquaresSums<double> sums;
  const double w = 0.25;
  for (const Vector p : {Vector{1, 0}, Vector{-1, 0}, Vector{0, 1}, Vector{0, -1}})
    sums.add(p.x, p.y, w, 2.0 * (10 + 3 * p.x - p.y), 2.0);
  sums.add(0, 0, 1.0, 2.0 * 10, 2.0);
  EXPECT_EQ(sums.a00, 4.0);
  EXPECT_EQ(sums.axx, 1.0);
  EXPECT_EQ(sums.axy, 0.0);
  EXPECT_NEAR(moving_least_squares_density(sums, 1.0, true), 10.0, 1e-14);
  EXPECT_EQ(moving_least_squares_density(sums, 77.0, false), 77.0);
}

TEST(MovingLeastSquaresDensity, FallsBackBelowItsThresholdOnly) {
  // det A = a00 axx ayy; Shepard gives 5, first order (5 - 0.1 x 20) with mx = 20, a0x = 0.1.
  const auto density = [](double ayy) {
    MovingLeastSquaresSums<double> s;
    s.a00 = 1;
    s.axx = 1;
    s.ayy = ayy;
    s.a0x = 0.1;
    s.m0 = 5;
    s.mx = 20;
    return moving_least_squares_density(s, 1.0, true);
  };
  EXPECT_NEAR(density(1.02e-3), (5 - 0.1 * 20) / 0.99, 1e-12);
  EXPECT_EQ(density(1.0e-3), 5.0);  // det = 0.99e-3
  EXPECT_EQ(density(0.0), 5.0);
}

}  // namespace
}  // namespace sphdrop
