#include "diagnostics/frequency.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace sphdrop {
namespace {

struct Signal {
  std::vector<double> times, values;
};

/// Numbers of a beam in mm and s: 362 1/s about -0.1 mm with a drift, from t = 1 ms on.
Signal damped(double decay_per_period, double phase, double periods, int samples, double noise = 0.0) {
  const double frequency = 362.0, decay = decay_per_period * frequency, amplitude = 0.3;
  std::mt19937_64 random(7);
  Signal signal;
  for (int i = 0; i < samples; ++i) {
    const double t = periods / frequency * i / (samples - 1);
    const double error = noise * (2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0);
    signal.times.push_back(1e-3 + t);
    signal.values.push_back(-0.1 + 5.0 * t + error +
                            amplitude * std::exp(-decay * t) *
                                std::cos(2.0 * std::numbers::pi * frequency * t + phase));
  }
  return signal;
}

TEST(Frequency, ZeroCrossingsOfALightlyDampedSinusoid) {
  for (const double periods : {3.4, 5.0, 7.75}) {
    for (const double phase : {0.0, 0.7, 1.57, 3.0, 5.0}) {
      const Signal signal = damped(0.01, phase, periods, 1000);
      const auto result = frequency_by_zero_crossings(signal.times, signal.values);
      EXPECT_NEAR(result.frequency / 362.0, 1.0, 1e-3) << periods << " periods, phase " << phase;
      EXPECT_NEAR(static_cast<double>(result.crossings.size()), 2.0 * periods, 1.0);
    }
  }
}

TEST(Frequency, CrossingsAreWhereTheSignalCrossesItsTrend) {
  const Signal signal = damped(0.0, 0.5, 4.0, 2000);
  const auto result = frequency_by_zero_crossings(signal.times, signal.values);
  ASSERT_EQ(result.crossings.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    const double turn = 0.25 + 0.5 * static_cast<double>(k) - 0.5 / (2.0 * std::numbers::pi);
    EXPECT_NEAR(result.crossings[k], 1e-3 + turn / 362.0, 1e-7);
  }
}

TEST(Frequency, NoiseAboutZeroIsNotCounted) {
  const Signal signal = damped(0.0, 0.5, 6.0, 3000, 0.01);
  const auto result = frequency_by_zero_crossings(signal.times, signal.values);
  EXPECT_EQ(result.crossings.size(), 12u);
  EXPECT_NEAR(result.frequency / 362.0, 1.0, 2e-3);
}

TEST(Frequency, FitRecoversAllParameters) {
  for (const double decay_per_period : {0.0, 0.05, 0.3}) {
    for (const double phase : {-2.0, 0.0, 1.0}) {
      for (const double periods : {2.3, 6.0}) {
        const Signal signal = damped(decay_per_period, phase, periods, 400);
        const DampedSinusoid fit = fit_damped_sinusoid(signal.times, signal.values);
        EXPECT_NEAR(fit.frequency / 362.0, 1.0, 1e-7);
        EXPECT_NEAR(fit.decay_rate, decay_per_period * 362.0, 1e-4);
        EXPECT_NEAR(fit.offset, -0.1, 1e-7);
        EXPECT_NEAR(fit.slope, 5.0, 1e-4);
        EXPECT_NEAR(fit.amplitude, 0.3, 1e-7);
        EXPECT_NEAR(fit.phase, phase, 1e-6);
        EXPECT_LT(fit.rms_residual, 1e-8);
      }
    }
  }
}

TEST(Frequency, FitUnderNoiseIsWithinATenthOfAPercent) {
  const Signal signal = damped(0.1, 0.4, 5.0, 2000, 0.01);
  const DampedSinusoid fit = fit_damped_sinusoid(signal.times, signal.values);
  EXPECT_NEAR(fit.frequency / 362.0, 1.0, 1e-3);
  EXPECT_NEAR(fit.decay_rate / 36.2, 1.0, 2e-2);
  EXPECT_NEAR(fit.rms_residual, 0.01 / std::sqrt(3.0), 5e-4);
}

TEST(Frequency, RefusesWhatHasNone) {
  std::vector<double> times, line;
  for (int i = 0; i < 100; ++i) {
    times.push_back(i);
    line.push_back(3.0 * i * i);
  }
  EXPECT_THROW(frequency_by_zero_crossings(times, line), std::invalid_argument);
  EXPECT_THROW(fit_damped_sinusoid(times, line), std::invalid_argument);
  const Signal good = damped(0.0, 0.0, 4.0, 100);
  EXPECT_THROW(fit_damped_sinusoid({good.times.data(), 7}, {good.values.data(), 7}), std::invalid_argument);
  EXPECT_THROW(fit_damped_sinusoid({good.times.data(), 99}, good.values), std::invalid_argument);
  Signal repeated = good;
  repeated.times[50] = repeated.times[49];
  EXPECT_THROW(fit_damped_sinusoid(repeated.times, repeated.values), std::invalid_argument);
}

}  // namespace
}  // namespace sphdrop
