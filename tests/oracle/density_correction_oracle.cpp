// Moving least squares against brute force over all particles.

#include <gtest/gtest.h>

#include <vector>

#include "fluid/density_correction.hpp"
#include "tests/oracle/reference_equations.hpp"
#include "tests/support/particle_samples.hpp"
#include "tests/support/same_bits.hpp"

namespace sphdrop {
namespace {

using test::FluidSample;
using test::smoothing_length;
using test::spacing;

constexpr CubicSpline kernel(smoothing_length);
constexpr double support = 2 * smoothing_length;

std::vector<double> brute_force(const std::vector<FluidSample>& sample) {
  std::vector<double> result;
  const double inverse_spacing = 1.0 / spacing;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    MovingLeastSquaresSums<double> sums;
    const FluidSample& own = sample[i];
    sums.add(0.0, 0.0, kernel.value(0.0), own.mass, own.mass / own.density);
    bool has_neighbours = false;
    for (std::size_t j = 0; j < sample.size(); ++j) {
      if (j == i) continue;
      const FluidSample& other = sample[j];
      const Vector x = own.position - other.position;
      const double w = kernel.value(length(x));
      has_neighbours = has_neighbours || w > 0;
      sums.add(x.x * inverse_spacing, x.y * inverse_spacing, w, other.mass, other.mass / other.density);
    }
    result.push_back(moving_least_squares_density(sums, own.density, has_neighbours));
  }
  return result;
}

/// By id; -1 for ids not owned.
std::vector<double> swept(const std::vector<FluidSample>& sample, const std::vector<std::int32_t>& owned,
                          const std::vector<std::int32_t>& ghosts, double reach) {
  FluidParticles fluid;
  test::fill(fluid, sample, owned, ghosts);
  const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], reach);
  std::vector<double> corrected(fluid.size(), -1.0), result(sample.size(), -1.0);
  moving_least_squares_densities(fluid, list, kernel, spacing, corrected);
  for (std::size_t row = 0; row < owned.size(); ++row) result[static_cast<std::size_t>(owned[row])] = corrected[row];
  return result;
}

class DensityCorrectionOracle : public ::testing::Test {
 protected:
  DensityCorrectionOracle() {
    sample.push_back({{1.0, 1.0}, {}, 990.0});  // alone
    sample.push_back({{2.0, 1.0}, {}, 985.0});  // a pair
    sample.push_back({{2.0, 1.0 + spacing}, {}, 995.0});
    all = test::first_ids(sample.size());
    expected = brute_force(sample);
  }

  std::vector<FluidSample> sample = test::random_fluid(23, 17, 110);
  std::vector<std::int32_t> all;
  std::vector<double> expected;
};

TEST_F(DensityCorrectionOracle, EqualsTheSumsInAscendingIdBitForBitWithAnySkin) {
  for (const double reach : {support, support + 0.4 * spacing, 1.5 * support}) {
    const std::vector<double> result = swept(sample, all, {}, reach);
    for (std::size_t id = 0; id < sample.size(); ++id) EXPECT_TRUE(test::same_bits(result[id], expected[id])) << id;
  }
}

TEST_F(DensityCorrectionOracle, DoesNotDependOnOrderOrOwnership) {
  test::RandomNumbers random(111);
  for (int k = 0; k < 6; ++k) {
    std::vector<std::int32_t> owned, ghosts;
    for (const std::int32_t id : all) (k == 0 || random.between(0, 1) < 0.5 ? owned : ghosts).push_back(id);
    random.shuffle(owned);
    random.shuffle(ghosts);
    const std::vector<double> result = swept(sample, owned, ghosts, support + 0.3 * spacing);
    for (const std::int32_t id : owned)
      EXPECT_TRUE(test::same_bits(result[static_cast<std::size_t>(id)], expected[static_cast<std::size_t>(id)])) << id;
  }
}

TEST_F(DensityCorrectionOracle, AgreesWithTheEquation) {
  const std::vector<double> result = swept(sample, all, {}, support + 0.3 * spacing);
  double largest_change = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double density = reference::moving_least_squares_density(sample, i, smoothing_length, spacing);
    EXPECT_NEAR(result[i], density, 1e-12 * density) << i;
    largest_change = std::max(largest_change, std::abs(result[i] - sample[i].density));
  }
  EXPECT_GT(largest_change, 5.0);  // it does something
}

}  // namespace
}  // namespace sphdrop
