#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fluid/density_diffusion.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::smoothing_length;
using test::spacing;

constexpr double reach = 2 * smoothing_length + 0.4 * spacing;
constexpr double coefficient = 0.1 * smoothing_length * 50;  // delta h c, m2/s

template <class Density>
void diffuse(FluidParticles& fluid, const std::vector<Vector>& positions, Density&& density) {
  std::vector<test::FluidSample> sample;
  sample.reserve(positions.size());
  for (const Vector& p : positions) sample.push_back({p, {}, density(p)});
  test::fill(fluid, sample, test::first_ids(sample.size()));
  const SmoothingKernel kernel = CubicSpline(smoothing_length);
  const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], reach);
  for (std::size_t row = 0; row < fluid.size(); ++row) fluid.density_rate[row] = 7.0;
  density_gradients(fluid, list, kernel);
  add_density_diffusion(fluid, list, kernel, coefficient);
}

std::vector<Vector> disordered_block(int columns, int rows) {
  test::RandomNumbers random(70);
  std::vector<Vector> positions = test::lattice(columns, rows, spacing);
  test::perturb(positions, 0.2 * spacing, random);
  return positions;
}

double linear_field(Vector p) {
  return 1000.0 * (1.0 + 0.01 * p.x / spacing - 0.02 * p.y / spacing);
}

TEST(DensityDiffusion, FindsTheGradientOfALinearFieldToTheVerySurface) {
  FluidParticles fluid;
  diffuse(fluid, disordered_block(13, 9), linear_field);
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    EXPECT_NEAR(fluid.density_gradient.x[row], 10.0 / spacing, 1e-10 / spacing) << row;
    EXPECT_NEAR(fluid.density_gradient.y[row], -20.0 / spacing, 1e-10 / spacing) << row;
  }
}

TEST(DensityDiffusion, VanishesForALinearField) {
  FluidParticles fluid;
  diffuse(fluid, disordered_block(13, 9), linear_field);
  const double scale = coefficient * 1000 / (spacing * spacing);
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    EXPECT_NEAR(fluid.density_diffusion[row], 0.0, 1e-12 * scale) << row;
    EXPECT_EQ(fluid.density_rate[row], 7.0 + fluid.density_diffusion[row]);
  }
}

// It is antisymmetric in i and j, so that no volume-weighted density comes or goes.
TEST(DensityDiffusion, MovesDensityAndMakesNone) {
  test::RandomNumbers random(71);
  FluidParticles fluid;
  diffuse(fluid, disordered_block(13, 9), [&](Vector) { return 1000.0 * random.between(0.98, 1.02); });
  double sum = 0, magnitude = 0;
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    const double change = fluid.mass[row] / fluid.density[row] * fluid.density_diffusion[row];
    sum += change;
    magnitude += std::abs(change);
  }
  EXPECT_GT(magnitude, 0.0);
  EXPECT_LE(std::abs(sum), 1e-13 * magnitude);
}

// A peak of one particle falls at the rate of the formula: without gradients, which symmetry makes vanish there.
TEST(DensityDiffusion, TakesDownAPeak) {
  const std::vector<Vector> lattice = test::lattice(11, 11, spacing);
  const std::size_t middle = 5 * 11 + 5;
  FluidParticles fluid;
  diffuse(fluid, lattice, [&](Vector p) { return length(p - lattice[middle]) < 0.1 * spacing ? 1010.0 : 1000.0; });
  const CubicSpline kernel(smoothing_length);
  double expected = 0;
  for (std::size_t j = 0; j < lattice.size(); ++j) {
    if (j == middle) continue;
    const Vector x = lattice[middle] - lattice[j];
    const Vector gradient{fluid.density_gradient.x[j], fluid.density_gradient.y[j]};
    const double slope = kernel.slope(length(x)) / length(x);
    expected += coefficient * fluid.mass[j] / 1000.0 * slope * (2 * 10.0 - dot(gradient, x));
  }
  EXPECT_LT(expected, 0.0);
  EXPECT_NEAR(fluid.density_gradient.x[middle], 0.0, 1e-9 / spacing);
  EXPECT_NEAR(fluid.density_diffusion[middle], expected, 1e-10 * std::abs(expected));
}

TEST(DensityDiffusion, HasNoGradientOnALineAndLeavesALoneParticleAlone) {
  FluidParticles fluid;
  std::vector<Vector> positions{{100 * spacing, 0}};
  for (int k = 0; k < 9; ++k) positions.push_back({0.6 * k * spacing, 0.8 * k * spacing});
  diffuse(fluid, positions, linear_field);
  for (std::size_t row = 0; row < fluid.size(); ++row) EXPECT_EQ(fluid.density_gradient.at(row), Vector{});
  EXPECT_EQ(fluid.density_diffusion[0], 0.0);
  // On a line it falls back to the plain difference, which evens out.
  EXPECT_GT(fluid.density_diffusion[9] * (linear_field(positions[5]) - linear_field(positions[9])), 0.0);
}

}  // namespace
}  // namespace sphdrop
