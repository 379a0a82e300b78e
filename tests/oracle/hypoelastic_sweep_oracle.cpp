// The hypoelastic solid's sweep against brute force over all pairs.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "solid/hypoelastic/artificial_stress.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "sph/equation_of_state.hpp"
#include "tests/oracle/reference_equations.hpp"
#include "tests/support/particle_samples.hpp"
#include "tests/support/same_bits.hpp"

namespace sphdrop {
namespace {

using test::Presence;
using test::smoothing_length;
using test::SolidSample;
using test::spacing;

constexpr double support = 2 * smoothing_length;
constexpr ElasticMaterial material{test::reference_density, 300e6, 0.3};

HypoelasticParameters parameters(double trace_factor, double artificial_stress_coefficient, double beta = 0.5) {
  const CubicSpline kernel(smoothing_length);
  return {{kernel, {2.0, beta, material.sound_speed(), smoothing_length}, 1.0 / kernel.value(spacing)},
          material,
          trace_factor,
          artificial_stress_coefficient};
}

enum Quantity { density_rate, acceleration_x, acceleration_y, tau_xx, tau_yy, tau_xy, heating, artificial_power };
using Rates = std::array<double, 8>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The pair formula in scalars over all other particles in ascending id.
std::vector<Rates> brute_force(const std::vector<SolidSample>& sample, const HypoelasticParameters& p) {
  std::vector<HypoelasticState<double>> states;
  for (const SolidSample& s : sample) {
    const double pressure = equation_of_state_pressure(s.density, material.sound_speed(), material.density);
    const SymmetricTensor<double> stress{s.tau_xx - pressure, s.tau_yy - pressure, s.tau_xy};
    states.push_back({s.position.x, s.position.y, s.velocity.x, s.velocity.y, s.density, s.mass, s.mass / s.density,
                      stress, artificial_stress(stress, s.density, p.artificial_stress_coefficient)});
  }
  std::vector<Rates> result;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    HypoelasticRates<double> r;
    for (std::size_t j = 0; j < sample.size(); ++j)
      if (j != i) add_hypoelastic_pair(p.pair, states[i], 1.0 / states[i].density, states[j], r);
    const SolidSample& s = sample[i];
    const auto tau = jaumann_stress_rate(r.gradient, SymmetricTensor<double>{s.tau_xx, s.tau_yy, s.tau_xy},
                                         material.shear_modulus(), p.trace_factor);
    result.push_back({r.density_rate, r.acceleration_x + r.artificial_x, r.acceleration_y + r.artificial_y, tau.xx,
                      tau.yy, tau.xy, r.dissipation_rate,
                      s.velocity.x * r.artificial_x + s.velocity.y * r.artificial_y});
  }
  return result;
}

/// One step's use of the sweep: blocks that need no ghosts while the ghosts hold another state, then the ghosts' true
/// state, then the other blocks. Result by id; NaN for ids not owned.
std::vector<Rates> swept(const std::vector<SolidSample>& sample, const std::vector<Presence>& presence, double reach,
                         const HypoelasticParameters& p) {
  SolidParticles solid;
  test::fill(solid, sample, presence);
  const auto list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, reach);
  for (std::size_t row = 0; row < solid.size(); ++row) {
    for (ScalarField* field : {&solid.density_rate, &solid.dissipation_rate, &solid.artificial_stress_power})
      (*field)[row] = nan;
    solid.acceleration.set(row, {nan, nan});
    for (Column<double>& column : solid.deviatoric_stress_rate.columns) column[row] = nan;
  }
  const HypoelasticSweep sweep(p);
  const auto for_each_ghost = [&](auto&& f) {
    for (const RowRange& range : solid.ghosts)
      for (std::int32_t k = range.begin; k < range.end; ++k) f(static_cast<std::size_t>(k));
  };
  for_each_ghost([&](std::size_t row) {
    solid.velocity.set(row, {7, -7});
    solid.density[row] = 1234;
    for (Column<double>& column : solid.deviatoric_stress.columns) column[row] = -9e6;
  });
  sweep.update_stress(solid, solid.ghosts);
  sweep.update_stress(solid, solid.owned);
  sweep.apply(solid, list, HypoelasticSweep::Blocks::without_ghosts);
  for_each_ghost([&](std::size_t row) {
    const SolidSample& s = sample[static_cast<std::size_t>(solid.id[row])];
    solid.velocity.set(row, s.velocity);
    solid.density[row] = s.density;
    solid.deviatoric_stress.xx[row] = s.tau_xx;
    solid.deviatoric_stress.yy[row] = s.tau_yy;
    solid.deviatoric_stress.xy[row] = s.tau_xy;
  });
  sweep.update_stress(solid, solid.ghosts);
  sweep.apply(solid, list, HypoelasticSweep::Blocks::with_ghosts);

  Rates none;
  none.fill(nan);
  std::vector<Rates> result(sample.size(), none);
  solid.for_each_owned([&](std::size_t row) {
    result[static_cast<std::size_t>(solid.id[row])] = {solid.density_rate[row],
                                                       solid.acceleration.x[row],
                                                       solid.acceleration.y[row],
                                                       solid.deviatoric_stress_rate.xx[row],
                                                       solid.deviatoric_stress_rate.yy[row],
                                                       solid.deviatoric_stress_rate.xy[row],
                                                       solid.dissipation_rate[row],
                                                       solid.artificial_stress_power[row]};
  });
  return result;
}

void expect_same_bits(const Rates& a, const Rates& b, std::size_t id) {
  for (std::size_t quantity = 0; quantity < a.size(); ++quantity)
    EXPECT_TRUE(test::same_bits(a[quantity], b[quantity])) << "particle " << id << ", quantity " << quantity;
}

class HypoelasticSweepOracle : public ::testing::Test {
 protected:
  const HypoelasticParameters p = parameters(1.0 / 3, 0.2);
  const std::vector<SolidSample> sample = test::random_solid(41, 9, 120);
  const std::vector<Presence> all_owned = std::vector<Presence>(sample.size(), Presence::owned);
  const std::vector<Rates> expected = brute_force(sample, p);
};

TEST_F(HypoelasticSweepOracle, EqualsThePairFormulaBitForBitWithAnySkin) {
  for (const double reach : {support, support + 0.1 * spacing, support + 0.4 * spacing, 1.5 * support}) {
    SCOPED_TRACE(reach / smoothing_length);
    const std::vector<Rates> result = swept(sample, all_owned, reach, p);
    for (std::size_t id = 0; id < sample.size(); ++id) expect_same_bits(result[id], expected[id], id);
  }
}

TEST_F(HypoelasticSweepOracle, EqualsThePairFormulaForOtherParameters) {
  for (const HypoelasticParameters& other :
       {parameters(0.5, 0.5), parameters(1.0 / 3, 0.0), parameters(1.0 / 3, 0.2, 0.0)}) {
    const std::vector<Rates> brute = brute_force(sample, other);
    const std::vector<Rates> result = swept(sample, all_owned, support + 0.3 * spacing, other);
    for (std::size_t id = 0; id < sample.size(); ++id) expect_same_bits(result[id], brute[id], id);
  }
}

TEST_F(HypoelasticSweepOracle, EqualsThePairFormulaHoweverThickTheBeam) {
  // From chains to more rows than pairs are kept for.
  for (const auto& [columns, rows] : {std::pair{30, 1}, {20, 3}, {14, 22}, {7, 60}, {6, 110}}) {
    SCOPED_TRACE(rows);
    const std::vector<SolidSample> thick = test::random_solid(columns, rows, 122);
    const std::vector<Rates> brute = brute_force(thick, p);
    const std::vector<Rates> result =
        swept(thick, std::vector<Presence>(thick.size(), Presence::owned), support + 0.3 * spacing, p);
    for (std::size_t id = 0; id < thick.size(); ++id) expect_same_bits(result[id], brute[id], id);
  }
}

TEST_F(HypoelasticSweepOracle, DoesNotDependOnWhereTheBeamIsCut) {
  const double reach = support + 0.3 * spacing;
  // A share of the columns is owned; ghosts are what lies within reach of it, the rest is not there. The blocks of
  // eight rows fall otherwise in every share.
  for (const auto& [first, last] : {std::pair{0, 7}, {0, 20}, {3, 4}, {7, 21}, {13, 38}, {30, 41}, {20, 41}}) {
    const double left = (first - 0.5) * spacing, right = (last - 0.5) * spacing;
    std::vector<Presence> presence;
    for (const SolidSample& s : sample)
      presence.push_back(s.position.x >= left && s.position.x < right                   ? Presence::owned
                         : s.position.x >= left - reach && s.position.x < right + reach ? Presence::ghost
                                                                                        : Presence::absent);
    SCOPED_TRACE(::testing::Message() << "columns " << first << " to " << last);
    const std::vector<Rates> result = swept(sample, presence, reach, p);
    for (std::size_t id = 0; id < sample.size(); ++id)
      if (presence[id] == Presence::owned) expect_same_bits(result[id], expected[id], id);
  }
}

TEST_F(HypoelasticSweepOracle, DoesNotDependOnGhostsInterleavedAtRandom) {
  test::RandomNumbers random(121);
  for (const double share : {0.05, 0.3, 0.9}) {
    std::vector<Presence> presence = all_owned;
    for (Presence& kind : presence)
      if (random.between(0, 1) < share) kind = Presence::ghost;
    const std::vector<Rates> result = swept(sample, presence, support + 0.3 * spacing, p);
    for (std::size_t id = 0; id < sample.size(); ++id)
      if (presence[id] == Presence::owned) expect_same_bits(result[id], expected[id], id);
  }
}

TEST_F(HypoelasticSweepOracle, DoesNotDependOnTheAlignmentOfBlocks) {
  // Lone particles with lower ids push the rows of the beam along.
  for (std::size_t pushed = 1; pushed <= 8; ++pushed) {
    std::vector<SolidSample> longer;
    for (std::size_t k = 0; k < pushed; ++k) longer.push_back({{-1.0 - 0.1 * static_cast<double>(k), 0.5}, {1, 1}});
    longer.insert(longer.end(), sample.begin(), sample.end());
    const std::vector<Presence> owned(longer.size(), Presence::owned);
    const std::vector<Rates> result = swept(longer, owned, support + 0.3 * spacing, p);
    for (std::size_t id = 0; id < sample.size(); ++id) expect_same_bits(result[id + pushed], expected[id], id);
    // Without the beam's first rows the others know only what is left.
    const std::vector<SolidSample> shorter(sample.begin() + static_cast<std::ptrdiff_t>(pushed), sample.end());
    const std::vector<Rates> brute = brute_force(shorter, p);
    const std::vector<Rates> rest =
        swept(shorter, std::vector<Presence>(shorter.size(), Presence::owned), support + 0.3 * spacing, p);
    for (std::size_t id = 0; id < shorter.size(); ++id) expect_same_bits(rest[id], brute[id], id);
  }
}

TEST(HypoelasticSweep, AgreesWithTheEquations) {
  for (const auto& [trace_factor, eps, seed] :
       {std::tuple{1.0 / 3, 0.2, 130u}, {0.5, 0.5, 131u}, {1.0 / 3, 0.0, 132u}}) {
    const std::vector<SolidSample> sample = test::random_solid(31, 10, seed);
    const HypoelasticParameters p = parameters(trace_factor, eps);
    const std::vector<Rates> rates =
        swept(sample, std::vector<Presence>(sample.size(), Presence::owned), support + 0.3 * spacing, p);
    const double poisson = 0.3, young = 300e6;
    const reference::Solid solid{young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson)), trace_factor, eps};
    const reference::Viscosity viscosity{2.0, 0.5, std::sqrt(solid.bulk_modulus / test::reference_density)};
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const reference::SolidRates r = reference::solid_rates(sample, i, smoothing_length, spacing, viscosity, solid);
      const auto expect_near = [&](Quantity quantity, double value, double magnitude) {
        EXPECT_NEAR(rates[i][quantity], value, 1e-12 * magnitude) << "particle " << i << ", quantity " << quantity;
      };
      expect_near(density_rate, r.density_rate.value, r.density_rate.magnitude);
      // Pressures come from small differences of densities: 1e-16 of c^2 rho, 250 MPa, is the stresses' own rounding.
      expect_near(acceleration_x, r.acceleration_x.value, r.acceleration_x.magnitude);
      expect_near(acceleration_y, r.acceleration_y.value, r.acceleration_y.magnitude);
      expect_near(tau_xx, r.deviatoric_stress_rate(0, 0), r.stress_rate_magnitude);
      expect_near(tau_yy, r.deviatoric_stress_rate(1, 1), r.stress_rate_magnitude);
      expect_near(tau_xy, r.deviatoric_stress_rate(0, 1), r.stress_rate_magnitude);
      expect_near(heating, r.heating.value, r.heating.magnitude);
      expect_near(artificial_power, r.artificial_stress_power, r.artificial_stress_power_magnitude);
    }
  }
}

TEST(HypoelasticSweep, UpdateStressEqualsTheScalarFormulasWhereverRangesEnd) {
  const std::vector<SolidSample> sample = test::random_solid(7, 9, 140);
  const HypoelasticSweep sweep(parameters(1.0 / 3, 0.2));
  SolidParticles solid;
  std::vector<Presence> presence(sample.size(), Presence::owned);
  for (const std::size_t ghost : {0u, 4u, 5u, 13u, 40u, 41u, 42u, 62u}) presence[ghost] = Presence::ghost;
  test::fill(solid, sample, presence);
  sweep.update_stress(solid, solid.owned);
  sweep.update_stress(solid, solid.ghosts);
  for (std::size_t row = 0; row < solid.size(); ++row) {
    const SolidSample& s = sample[row];
    const double pressure = equation_of_state_pressure(s.density, material.sound_speed(), material.density);
    const SymmetricTensor<double> stress{s.tau_xx - pressure, s.tau_yy - pressure, s.tau_xy};
    const SymmetricTensor<double> artificial = artificial_stress(stress, s.density, 0.2);
    EXPECT_TRUE(test::same_bits(solid.pressure[row], pressure)) << row;
    EXPECT_TRUE(test::same_bits(solid.volume[row], s.mass / s.density)) << row;
    EXPECT_TRUE(test::same_bits(solid.stress.xx[row], stress.xx)) << row;
    EXPECT_TRUE(test::same_bits(solid.stress.yy[row], stress.yy)) << row;
    EXPECT_TRUE(test::same_bits(solid.stress.xy[row], stress.xy)) << row;
    EXPECT_TRUE(test::same_bits(solid.artificial_stress.xx[row], artificial.xx)) << row;
    EXPECT_TRUE(test::same_bits(solid.artificial_stress.yy[row], artificial.yy)) << row;
    EXPECT_TRUE(test::same_bits(solid.artificial_stress.xy[row], artificial.xy)) << row;
  }
}

}  // namespace
}  // namespace sphdrop
