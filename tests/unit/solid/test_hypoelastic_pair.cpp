#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "particles/vector.hpp"
#include "solid/hypoelastic/hypoelastic_pair.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

constexpr double h = 3e-5, d = 2.5e-5;
const HypoelasticPairParameters parameters{CubicSpline(h),
                                           {.alpha = 2.0, .beta = 0.5, .sound_speed = 500, .smoothing_length = h},
                                           1.0 / CubicSpline(h).value(d)};

using State = HypoelasticState<double>;
using Rates = HypoelasticRates<double>;

Rates rates_of(const HypoelasticPairParameters& p, const State& i, const State& j) {
  Rates rates;
  add_hypoelastic_pair(p, i, 1.0 / i.density, j, rates);
  return rates;
}

State random_state(test::RandomNumbers& random) {
  State s{.x = random.between(0, 1.2 * h),
          .y = random.between(0, 1.2 * h),
          .velocity_x = random.between(-1, 1),
          .velocity_y = random.between(-1, 1),
          .density = random.between(980, 1020),
          .mass = random.between(5e-7, 8e-7),
          .volume = 0,
          .stress = {},
          .artificial_stress = {}};
  s.volume = s.mass / s.density;
  for (double* value : {&s.stress.xx, &s.stress.yy, &s.stress.xy}) *value = random.between(-1e6, 1e6);
  for (double* value : {&s.artificial_stress.xx, &s.artificial_stress.yy, &s.artificial_stress.xy})
    *value = random.between(-0.2, 0.2);
  return s;
}

// h = 1, x_ij = 1.5 (0.6, 0.8): W = a/48 and dW/dr = -a/8 with a = 15/(7 pi). v_ij = (-2, 1).
TEST(HypoelasticPair, HasTheValuesWorkedOutByHand) {
  const double a = 15 / (7 * std::numbers::pi);
  const HypoelasticPairParameters simple{
      CubicSpline(1.0), {.alpha = 0.5, .beta = 2, .sound_speed = 3, .smoothing_length = 1}, 24 / a};  // f = 1/2
  const State i{0.9, 1.2, -1, 0, 2, 0.7, 0.35, {1, 2, 3}, {-0.1, -0.2, 0.3}};
  const State j{0, 0, 1, -1, 4, 0.3, 0.075, {5, -4, 2}, {-0.5, 0, 0.1}};
  const double gx = -a / 8 * 0.6, gy = -a / 8 * 0.8;
  const double mu = -0.6 / (2.25 + 0.01);
  const double pi = (-0.5 * 3 * mu + 2 * mu * mu) / 3;

  const Rates rates = rates_of(simple, i, j);
  EXPECT_NEAR(rates.density_rate, 0.3 * (-2 * gx + 1 * gy), 1e-15);  // (9)
  EXPECT_NEAR(rates.gradient.xx, 0.075 * 2 * gx, 1e-15);             // (15, 16): v_j - v_i = (2, -1)
  EXPECT_NEAR(rates.gradient.xy, 0.075 * 2 * gy, 1e-15);
  EXPECT_NEAR(rates.gradient.yx, 0.075 * -1 * gx, 1e-15);
  EXPECT_NEAR(rates.gradient.yy, 0.075 * -1 * gy, 1e-15);
  EXPECT_NEAR(rates.acceleration_x, 0.3 * ((6.0 / 8 - pi) * gx + 5.0 / 8 * gy), 1e-15);  // (14)
  EXPECT_NEAR(rates.acceleration_y, 0.3 * (5.0 / 8 * gx + (-2.0 / 8 - pi) * gy), 1e-15);
  EXPECT_NEAR(rates.artificial_x, 0.3 / 16 * (-0.6 * gx + 0.4 * gy), 1e-15);  // (19), n = 4
  EXPECT_NEAR(rates.artificial_y, 0.3 / 16 * (0.4 * gx - 0.2 * gy), 1e-15);
  EXPECT_NEAR(rates.dissipation_rate, 0.5 * 0.3 * pi * (-2 * gx + 1 * gy), 1e-15);
}

TEST(HypoelasticPair, TensionPullsTogetherAndArtificialStressOpposesIt) {
  State i{d, 0, 0, 0, 1000, 6e-7, 6e-10, {1e5, 0, 0}, {-0.02, 0, 0}}, j = i;
  j.x = 0;
  const Rates rates = rates_of(parameters, i, j);
  EXPECT_LT(rates.acceleration_x, 0);
  EXPECT_GT(rates.artificial_x, 0);
  // At distance d, f = 1: R weighs as much as sigma/rho^2, of which it is eps = 0.2.
  EXPECT_NEAR(rates.artificial_x / rates.acceleration_x, -0.2, 1e-14);
}

TEST(HypoelasticPair, ForcesAreOpposite) {
  test::RandomNumbers random(60);
  for (int k = 0; k < 1000; ++k) {
    const State i = random_state(random), j = random_state(random);
    const Rates on_i = rates_of(parameters, i, j), on_j = rates_of(parameters, j, i);
    const Vector force_i = i.mass * Vector{on_i.acceleration_x, on_i.acceleration_y};
    const Vector force_j = j.mass * Vector{on_j.acceleration_x, on_j.acceleration_y};
    EXPECT_LE(length(force_i + force_j), 1e-13 * length(force_i));
    const Vector artificial_i = i.mass * Vector{on_i.artificial_x, on_i.artificial_y};
    const Vector artificial_j = j.mass * Vector{on_j.artificial_x, on_j.artificial_y};
    EXPECT_LE(length(artificial_i + artificial_j), 1e-13 * length(artificial_i));
  }
}

TEST(HypoelasticPair, ViscosityTurnsKineticEnergyIntoHeat) {
  test::RandomNumbers random(61);
  for (int k = 0; k < 1000; ++k) {
    State i = random_state(random), j = random_state(random);
    i.stress = j.stress = {};
    const Rates on_i = rates_of(parameters, i, j), on_j = rates_of(parameters, j, i);
    const double power = i.mass * (i.velocity_x * on_i.acceleration_x + i.velocity_y * on_i.acceleration_y) +
                         j.mass * (j.velocity_x * on_j.acceleration_x + j.velocity_y * on_j.acceleration_y);
    const double heat = i.mass * on_i.dissipation_rate + j.mass * on_j.dissipation_rate;
    EXPECT_GE(heat, 0.0);
    EXPECT_NEAR(power + heat, 0.0, 1e-14 * i.mass * std::hypot(on_i.acceleration_x, on_i.acceleration_y));
  }
}

// The gradient's trace is -(1/rho) drho/dt where all particles have one density: Eq 9 against Eqs 15, 16.
TEST(HypoelasticPair, DensityRateIsTheDivergenceOfTheVelocity) {
  test::RandomNumbers random(62);
  for (int k = 0; k < 200; ++k) {
    const State i = random_state(random), j = random_state(random);
    const Rates rates = rates_of(parameters, i, j);
    const double magnitude = j.mass * std::abs(parameters.kernel.slope(std::hypot(i.x - j.x, i.y - j.y)));
    EXPECT_NEAR(rates.density_rate, -j.density * (rates.gradient.xx + rates.gradient.yy), 1e-14 * magnitude);
  }
}

TEST(HypoelasticPair, ContributesAnExactZeroOutOfReachAndToItself) {
  test::RandomNumbers random(63);
  const State i = random_state(random);
  State far = random_state(random);
  far.x = i.x + 2.0001 * h;
  const State padding{1e6, 1e6, 0, 0, 1, 0, 0, {-2.5e8, -2.5e8, 0}, {0, 0, 0}};
  for (const State& j : {i, far, padding}) {
    const Rates r = rates_of(parameters, i, j);
    for (const double rate : {r.density_rate, r.acceleration_x, r.acceleration_y, r.artificial_x, r.artificial_y,
                              r.dissipation_rate, r.gradient.xx, r.gradient.xy, r.gradient.yx, r.gradient.yy})
      EXPECT_EQ(rate, 0.0);
  }
}

}  // namespace
}  // namespace sphdrop
