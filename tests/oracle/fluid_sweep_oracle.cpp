// The liquid's sweep against brute force over all pairs.

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "fluid/fluid_sweep.hpp"
#include "sph/equation_of_state.hpp"
#include "tests/oracle/reference_equations.hpp"
#include "tests/support/particle_samples.hpp"
#include "tests/support/same_bits.hpp"

namespace sphdrop {
namespace {

using test::FluidSample;
using test::smoothing_length;
using test::spacing;

constexpr double sound_speed = 50;
constexpr reference::Viscosity viscosity{0.1, 0.6, sound_speed};
constexpr FluidPairParameters<> parameters{CubicSpline(smoothing_length),
                                           {viscosity.alpha, viscosity.beta, viscosity.sound_speed, smoothing_length}};
constexpr double support = 2 * smoothing_length;

struct Rates {
  double density_rate, acceleration_x, acceleration_y, dissipation_rate;
};

/// The pair formula in scalars over all other particles in ascending id.
std::vector<Rates> brute_force(const std::vector<FluidSample>& sample, const FluidPairParameters<>& p = parameters) {
  const auto state = [&](std::size_t id) {
    const FluidSample& s = sample[id];
    return FluidState<double>{s.position.x, s.position.y,
                              s.velocity.x, s.velocity.y,
                              s.density,    equation_of_state_pressure(s.density, sound_speed, test::reference_density),
                              s.mass,       s.mass / s.density};
  };
  std::vector<Rates> result;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const FluidState<double> own = state(i);
    FluidRates<double> rates;
    for (std::size_t j = 0; j < sample.size(); ++j)
      if (j != i) add_fluid_pair(p, own, 1.0 / own.density, state(j), rates);
    result.push_back({rates.density_rate, rates.acceleration_x, rates.acceleration_y, rates.dissipation_rate});
  }
  return result;
}

/// One step's use of the sweep: rows that need no ghosts first (`inner` of them), then the ghosts' records, then the
/// other rows. Result by id; NaN for ids not owned.
std::vector<Rates> swept(const std::vector<FluidSample>& sample, const std::vector<std::int32_t>& owned,
                         const std::vector<std::int32_t>& ghosts, std::int32_t inner, double reach,
                         const FluidPairParameters<>& p = parameters) {
  FluidParticles fluid;
  test::fill(fluid, sample, owned, ghosts);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    fluid.pressure[row] = equation_of_state_pressure(fluid.density[row], sound_speed, test::reference_density);
    fluid.density_rate[row] = fluid.acceleration.x[row] = fluid.acceleration.y[row] = fluid.dissipation_rate[row] = nan;
  }
  const auto end = static_cast<std::int32_t>(owned.size());
  const auto first = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, RowRange{0, inner}, reach);
  const auto rest = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, RowRange{inner, end}, reach);
  FluidSweep sweep(p);
  sweep.resize(fluid);
  sweep.pack(fluid, fluid.owned);
  sweep.apply(fluid, first);
  sweep.pack(fluid, fluid.ghosts);
  sweep.apply(fluid, rest);
  std::vector<Rates> result(sample.size(), {nan, nan, nan, nan});
  for (std::size_t row = 0; row < owned.size(); ++row)
    result[static_cast<std::size_t>(owned[row])] = {fluid.density_rate[row], fluid.acceleration.x[row],
                                                    fluid.acceleration.y[row], fluid.dissipation_rate[row]};
  return result;
}

void expect_same_bits(const std::vector<Rates>& a, const std::vector<Rates>& b, const std::vector<std::int32_t>& ids) {
  for (const std::int32_t id : ids) {
    const auto k = static_cast<std::size_t>(id);
    EXPECT_TRUE(test::same_bits(a[k].density_rate, b[k].density_rate)) << id;
    EXPECT_TRUE(test::same_bits(a[k].acceleration_x, b[k].acceleration_x)) << id;
    EXPECT_TRUE(test::same_bits(a[k].acceleration_y, b[k].acceleration_y)) << id;
    EXPECT_TRUE(test::same_bits(a[k].dissipation_rate, b[k].dissipation_rate)) << id;
  }
}

class FluidSweepOracle : public ::testing::Test {
 protected:
  FluidSweepOracle() {
    // Two particles in one place, one far from all others: what a wild run may show.
    sample.push_back(sample[40]);
    sample.back().velocity = {0.3, 0.7};
    sample.push_back({{1.0, 1.0}, {0, 0}});
    all = test::first_ids(sample.size());
    expected = brute_force(sample);
  }

  std::vector<FluidSample> sample = test::random_fluid(23, 17, 100);
  std::vector<std::int32_t> all;
  std::vector<Rates> expected;
};

TEST_F(FluidSweepOracle, EqualsThePairFormulaBitForBitWithAnySkin) {
  for (const double reach : {support, support + 0.1 * spacing, support + 0.4 * spacing, 1.5 * support}) {
    SCOPED_TRACE(reach / smoothing_length);
    expect_same_bits(swept(sample, all, {}, 0, reach), expected, all);
  }
}

TEST_F(FluidSweepOracle, EqualsThePairFormulaWithoutTheQuadraticTermOfViscosity) {
  FluidPairParameters<> linear = parameters;
  linear.viscosity.beta = 0.0;
  expect_same_bits(swept(sample, all, {}, 0, support + 0.3 * spacing, linear), brute_force(sample, linear), all);
}

TEST_F(FluidSweepOracle, DoesNotDependOnTheOrderOfRows) {
  test::RandomNumbers random(101);
  for (int k = 0; k < 5; ++k) {
    std::vector<std::int32_t> order = all;
    random.shuffle(order);
    expect_same_bits(swept(sample, order, {}, 0, support + 0.3 * spacing), expected, all);
  }
}

TEST_F(FluidSweepOracle, DoesNotDependOnWhoOwnsWhat) {
  test::RandomNumbers random(102);
  for (int k = 0; k < 8; ++k) {
    // Owned: what lies left of a cut, or a random choice; the inner rows, of any number, have no ghost in reach.
    const double reach = support + 0.3 * spacing, cut = random.between(0, 22) * spacing;
    std::vector<std::int32_t> inner, border, ghosts;
    for (const std::int32_t id : all) {
      const Vector p = sample[static_cast<std::size_t>(id)].position;
      const bool owned = k % 2 == 0 ? p.x < cut : random.between(0, 1) < 0.6;
      const bool near = k % 2 == 1 || p.x > cut - reach;
      (owned ? (near ? border : inner) : ghosts).push_back(id);
    }
    for (auto* rows : {&inner, &border, &ghosts}) random.shuffle(*rows);
    std::vector<std::int32_t> owned = inner;
    owned.insert(owned.end(), border.begin(), border.end());
    SCOPED_TRACE(::testing::Message() << inner.size() << " inner, " << border.size() << " border, " << ghosts.size()
                                      << " ghosts");
    expect_same_bits(swept(sample, owned, ghosts, static_cast<std::int32_t>(inner.size()), reach), expected, owned);
  }
}

TEST_F(FluidSweepOracle, AgreesWithTheEquations) {
  const std::vector<Rates> rates = swept(sample, all, {}, 0, support + 0.3 * spacing);
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const reference::FluidRates r = reference::fluid_rates(sample, i, smoothing_length, viscosity, sound_speed);
    EXPECT_NEAR(rates[i].density_rate, r.density_rate.value, 1e-12 * r.density_rate.magnitude) << i;
    EXPECT_NEAR(rates[i].acceleration_x, r.acceleration_x.value, 1e-12 * r.acceleration_x.magnitude) << i;
    EXPECT_NEAR(rates[i].acceleration_y, r.acceleration_y.value, 1e-12 * r.acceleration_y.magnitude) << i;
    EXPECT_NEAR(rates[i].dissipation_rate, r.heating.value, 1e-12 * r.heating.magnitude) << i;
  }
}

// Rows may come and go between steps; what an earlier, larger set left behind must not matter.
TEST(FluidSweep, FollowsTheNumberOfRows) {
  FluidSweep sweep(parameters);
  for (const int columns : {15, 4, 9}) {
    const std::vector<FluidSample> sample = test::random_fluid(columns, 7, 103);
    FluidParticles fluid;
    test::fill(fluid, sample, test::first_ids(sample.size()));
    for (std::size_t row = 0; row < fluid.size(); ++row)
      fluid.pressure[row] = equation_of_state_pressure(fluid.density[row], sound_speed, test::reference_density);
    const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], support);
    sweep.resize(fluid);
    sweep.pack(fluid, fluid.owned);
    sweep.apply(fluid, list);
    const std::vector<Rates> expected = brute_force(sample);
    for (std::size_t row = 0; row < fluid.size(); ++row) {
      EXPECT_TRUE(test::same_bits(fluid.density_rate[row], expected[row].density_rate)) << row;
      EXPECT_TRUE(test::same_bits(fluid.acceleration.x[row], expected[row].acceleration_x)) << row;
    }
  }
}

}  // namespace
}  // namespace sphdrop
