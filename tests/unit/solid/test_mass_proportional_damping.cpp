#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solid/mass_proportional_damping.hpp"
#include "time_integration/leapfrog.hpp"

namespace sphdrop {
namespace {

// Short binary fractions, so that exact means equal.
TEST(MassProportionalDamping, AddsMinusRateTimesVelocityAndItsHeat) {
  SolidParticles p;
  p.resize(4);
  p.owned = {{0, 1}, {2, 4}};
  for (std::size_t row = 0; row < 4; ++row) {
    p.velocity.set(row, {0.5, -2});
    p.acceleration.set(row, {1, 10});
    p.dissipation_rate[row] = 7;
  }
  p.velocity.set(3, {});  // held
  add_mass_proportional_damping(p, 4.0);
  for (const std::size_t row : {0u, 2u}) {
    EXPECT_EQ(p.acceleration.at(row), (Vector{-1, 18})) << row;
    EXPECT_EQ(p.dissipation_rate[row], 7 + 4 * 4.25) << row;
  }
  for (const std::size_t row : {1u, 3u}) {
    EXPECT_EQ(p.acceleration.at(row), (Vector{1, 10})) << row;
    EXPECT_EQ(p.dissipation_rate[row], 7) << row;
  }
}

struct Coasting {
  double velocity_error, unaccounted_energy;
};

/// A particle of mass 3 kg/m at 2 m/s that nothing else acts on, for a time of 1/rate.
Coasting coast(int steps) {
  constexpr double rate = 8.0, mass = 3.0;
  SolidParticles p;
  p.resize(1);
  p.owned = {{0, 1}};
  p.mass[0] = mass;
  p.staggered_velocity.set(0, {2, 0});
  const double step = 1.0 / rate / steps;
  double previous = 0;
  for (int k = 0; k < steps; ++k) {
    predict(p, previous);
    p.acceleration.set(0, {});
    p.dissipation_rate[0] = 0;
    add_mass_proportional_damping(p, rate);
    kick_and_drift(p, {previous, step}, std::numeric_limits<double>::infinity());
    previous = step;
  }
  predict(p, previous);
  const double v = p.velocity.x[0];
  return {std::abs(v - 2 * std::exp(-1.0)), std::abs(0.5 * mass * (v * v - 4) + p.dissipated_energy[0])};
}

TEST(MassProportionalDamping, SlowsAFreeParticleExponentially) {
  const Coasting coarse = coast(50), fine = coast(200);
  EXPECT_LT(coarse.velocity_error, 1e-3);
  EXPECT_NEAR(std::log(coarse.velocity_error / fine.velocity_error) / std::log(4.0), 2.0, 0.2);
}

// Heat is summed up from the power at each step's beginning, which is right to first order.
TEST(MassProportionalDamping, TurnsTheKineticEnergyThatIsLostIntoHeat) {
  const Coasting coarse = coast(50), fine = coast(200);
  EXPECT_LT(coarse.unaccounted_energy, 0.02 * 6.0);
  EXPECT_NEAR(std::log(coarse.unaccounted_energy / fine.unaccounted_energy) / std::log(4.0), 1.0, 0.2);
}

}  // namespace
}  // namespace sphdrop
