#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "fluid/fluid_pair.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

constexpr double h = 3e-5;
constexpr FluidPairParameters<> parameters{CubicSpline(h),
                                           {.alpha = 0.1, .beta = 0.5, .sound_speed = 50, .smoothing_length = h}};

FluidRates<double> rates_of(const FluidPairParameters<>& p, const FluidState<double>& i, const FluidState<double>& j) {
  FluidRates<double> rates;
  add_fluid_pair(p, i, 1.0 / i.density, j, rates);
  return rates;
}

FluidState<double> random_state(test::RandomNumbers& random) {
  FluidState<double> s{
      random.between(0, 1.2 * h), random.between(0, 1.2 * h), random.between(-1, 1),      random.between(-1, 1),
      random.between(980, 1020),  random.between(-1e4, 1e4),  random.between(5e-7, 8e-7), 0};
  s.volume = s.mass / s.density;
  return s;
}

// h = 1, x_ij = 1.5 (0.6, 0.8): dW/dr = -a/8 with a = 15/(7 pi). v_ij = (-2, 1), so v_ij.x_ij = -0.6.
TEST(FluidPair, HasTheValuesWorkedOutByHand) {
  const FluidPairParameters<> simple{CubicSpline(1.0),
                                     {.alpha = 0.5, .beta = 2, .sound_speed = 3, .smoothing_length = 1}};
  const FluidState<double> i{0.9, 1.2, -1, 0, 2, 5, 0.7, 0.35};
  const FluidState<double> j{0, 0, 1, -1, 4, 7, 0.3, 0.075};
  const double slope = -15 / (7 * std::numbers::pi) / 8;
  const double mu = -0.6 / (2.25 + 0.01);
  const double pi = (-0.5 * 3 * mu + 2 * mu * mu) / 3;

  const FluidRates<double> rates = rates_of(simple, i, j);
  EXPECT_NEAR(rates.density_rate, 0.3 * (-2 * 0.6 + 1 * 0.8) * slope, 1e-15);  // (9)
  const double force = -0.3 * ((5 + 7) / (2.0 * 4.0) + pi) * slope;            // (12)
  EXPECT_NEAR(rates.acceleration_x, force * 0.6, 1e-15);
  EXPECT_NEAR(rates.acceleration_y, force * 0.8, 1e-15);
  EXPECT_NEAR(rates.dissipation_rate, 0.5 * 0.3 * pi * (-0.4) * slope, 1e-15);
}

TEST(FluidPair, PressurePushesApartAndTensionPullsTogether) {
  FluidState<double> i{h, 0, 0, 0, 1000, 100, 1e-6, 1e-9}, j{0, 0, 0, 0, 1000, 100, 1e-6, 1e-9};
  EXPECT_GT(rates_of(parameters, i, j).acceleration_x, 0);
  i.pressure = j.pressure = -100;
  EXPECT_LT(rates_of(parameters, i, j).acceleration_x, 0);
}

TEST(FluidPair, DensityGrowsAsParticlesApproach) {
  const FluidState<double> i{h, 0, -1, 0, 1000, 0, 1e-6, 1e-9}, j{0, 0, 0, 0, 1000, 0, 1e-6, 1e-9};
  EXPECT_GT(rates_of(parameters, i, j).density_rate, 0);
  EXPECT_LT(rates_of(parameters, i, {0, 0, -2, 0, 1000, 0, 1e-6, 1e-9}).density_rate, 0);
}

TEST(FluidPair, ForcesAreOppositeAndAlongTheLineOfCentres) {
  test::RandomNumbers random(20);
  for (int k = 0; k < 1000; ++k) {
    const FluidState<double> i = random_state(random), j = random_state(random);
    const FluidRates<double> on_i = rates_of(parameters, i, j), on_j = rates_of(parameters, j, i);
    const Vector force_i = i.mass * Vector{on_i.acceleration_x, on_i.acceleration_y};
    const Vector force_j = j.mass * Vector{on_j.acceleration_x, on_j.acceleration_y};
    // Pressure and viscosity may nearly cancel; each is rounded for itself.
    const double r = std::hypot(i.x - j.x, i.y - j.y);
    const double pressure_force = i.mass * j.volume * 2e4 / i.density * std::abs(parameters.kernel.slope(r));
    EXPECT_LE(length(force_i + force_j), 1e-14 * (length(force_i) + pressure_force));
    EXPECT_LE(std::abs(cross(force_i, Vector{i.x - j.x, i.y - j.y})), 1e-15 * length(force_i) * 2 * h);
  }
}

// What viscosity takes from the kinetic energy of the pair is what heats it, half and half.
TEST(FluidPair, ViscosityTurnsKineticEnergyIntoHeat) {
  test::RandomNumbers random(21);
  int approaching = 0;
  for (int k = 0; k < 1000; ++k) {
    FluidState<double> i = random_state(random), j = random_state(random);
    i.pressure = j.pressure = 0;
    const FluidRates<double> on_i = rates_of(parameters, i, j), on_j = rates_of(parameters, j, i);
    const double power = i.mass * (i.velocity_x * on_i.acceleration_x + i.velocity_y * on_i.acceleration_y) +
                         j.mass * (j.velocity_x * on_j.acceleration_x + j.velocity_y * on_j.acceleration_y);
    const double heat_i = i.mass * on_i.dissipation_rate, heat_j = j.mass * on_j.dissipation_rate;
    EXPECT_GE(heat_i, 0.0);
    EXPECT_NEAR(heat_i, heat_j, 1e-14 * heat_i);
    const double scale = i.mass * std::hypot(on_i.acceleration_x, on_i.acceleration_y);  // times velocities of order 1
    EXPECT_NEAR(power + heat_i + heat_j, 0.0, 1e-14 * scale);
    approaching += heat_i > 0;
  }
  EXPECT_GT(approaching, 300);
  EXPECT_LT(approaching, 700);
}

TEST(FluidPair, IsInvariantUnderAMovingFrame) {
  test::RandomNumbers random(22);
  for (int k = 0; k < 1000; ++k) {
    FluidState<double> i = random_state(random), j = random_state(random);
    const FluidRates<double> at_rest = rates_of(parameters, i, j);
    for (FluidState<double>* s : {&i, &j}) {
      s->velocity_x += 8;
      s->velocity_y -= 16;
    }
    const FluidRates<double> moving = rates_of(parameters, i, j);
    // Adding 16 to a velocity of order 1 rounds it to 2e-15.
    const double gradient = i.mass * std::abs(parameters.kernel.slope(std::hypot(i.x - j.x, i.y - j.y)));
    EXPECT_NEAR(moving.density_rate, at_rest.density_rate, 2e-14 * gradient);
    const double scale = 1e-13 * gradient * 200;  // viscous accelerations: Pi up to alpha c h/(rho 0.1 h) and so on
    EXPECT_NEAR(moving.acceleration_x, at_rest.acceleration_x, scale);
    EXPECT_NEAR(moving.acceleration_y, at_rest.acceleration_y, scale);
  }
}

TEST(FluidPair, ContributesAnExactZeroOutOfReachAndToItself) {
  test::RandomNumbers random(23);
  const FluidState<double> i = random_state(random);
  FluidState<double> far = random_state(random);
  far.x = i.x + 2.0001 * h;
  FluidState<double> padding{1e6, 1e6, 0, 0, 1, 0, 0, 0};
  for (const FluidState<double>& j : {i, far, padding}) {
    const FluidRates<double> rates = rates_of(parameters, i, j);
    EXPECT_EQ(rates.density_rate, 0.0);
    EXPECT_EQ(rates.acceleration_x, 0.0);
    EXPECT_EQ(rates.acceleration_y, 0.0);
    EXPECT_EQ(rates.dissipation_rate, 0.0);
  }
}

TEST(FluidPair, StaysFiniteWhereTwoParticlesCoincide) {
  test::RandomNumbers random(24);
  const FluidState<double> i = random_state(random);
  FluidState<double> j = random_state(random);
  for (const double gap : {0.0, 1e-300, 1e-25, 1e-15}) {
    j.x = i.x + gap;
    j.y = i.y;
    const FluidRates<double> rates = rates_of(parameters, i, j);
    EXPECT_TRUE(std::isfinite(rates.density_rate)) << gap;
    EXPECT_TRUE(std::isfinite(rates.acceleration_x)) << gap;
    EXPECT_TRUE(std::isfinite(rates.acceleration_y)) << gap;
  }
}

}  // namespace
}  // namespace sphdrop
