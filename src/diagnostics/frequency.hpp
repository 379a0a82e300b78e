#pragma once
// The frequency of a sampled oscillation, such as a beam's deflection delta(t), for reports.

#include <span>
#include <vector>

namespace sphdrop {

/// Frequency from the times at which the signal crosses its own trend.
struct ZeroCrossingFrequency {
  double frequency = 0;           ///< 1/s
  std::vector<double> crossings;  ///< s, both directions
};

/// Counts the crossings of a signal with its trend (offset + slope t) removed, each interpolated linearly between two
/// samples, and takes half the period from the straight line through crossing time against number. The trend is fitted
/// together with a sinusoid, for a straight line fitted alone would follow the oscillation. A crossing counts only if
/// the signal then goes beyond a tenth of its r.m.s. value, so that noise about zero is not counted. Assumes light
/// damping; under strong damping use fit_damped_sinusoid. Times in s must increase, and need not be evenly spaced.
/// Throws std::invalid_argument for fewer than 8 samples, unequal lengths, times that do not increase, or fewer than
/// three crossings.
ZeroCrossingFrequency frequency_by_zero_crossings(std::span<const double> times, std::span<const double> values);

/// y(t) = offset + slope (t - t_first) + amplitude exp(-decay_rate (t - t_first)) cos(2 pi frequency (t - t_first) +
/// phase).
struct DampedSinusoid {
  double frequency = 0;                         ///< 1/s
  double decay_rate = 0;                        ///< 1/s
  double offset = 0, slope = 0, amplitude = 0;  ///< in the signal's unit (slope: per s)
  double phase = 0;                             ///< rad
  double rms_residual = 0;                      ///< in the signal's unit
};

/// Least-squares fit of a damped sinusoid with a linear trend, by Levenberg and Marquardt's method started from the
/// zero crossings. Throws as frequency_by_zero_crossings does, and std::runtime_error where the fit does not converge.
DampedSinusoid fit_damped_sinusoid(std::span<const double> times, std::span<const double> values);

}  // namespace sphdrop
