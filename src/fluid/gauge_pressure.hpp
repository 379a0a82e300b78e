#pragma once
// A reference pressure that a drop's pressures are counted from.

#include <algorithm>
#include <cmath>

namespace sphdrop {

/// The pressure that particles need to be under so that all but a few stay above zero: mean p - 3 std p, and never
/// negative, Pa. From the sums over a drop's particles of p, p^2 and 1.
inline double gauge_target(double pressure_sum, double squared_pressure_sum, double count) {
  if (!(count > 0)) return 0;
  const double mean = pressure_sum / count;
  const double variance = std::max(0.0, squared_pressure_sum / count - mean * mean);
  return std::max(0.0, mean - 3.0 * std::sqrt(variance));
}

/// A drop's gauge pressure p_ref. With it, the equation of state gives the pressure above p_ref, p_ref itself acts on
/// the drop's surface alone, and the particles' lattice, which is stiff under pressure, does not feel it.
struct GaugePressure {
  double pressure = 0;  ///< p_ref, Pa
  double target = 0;    ///< of the last instant, Pa

  /// dp = (target - p_ref) step / relaxation_time, which is added to p_ref and returned, Pa: each particle's density is
  /// to fall by dp/c^2, so that no pressure changes. Times in s.
  double relax(double step, double relaxation_time) {
    const double change = (target - pressure) * std::min(1.0, step / relaxation_time);
    pressure += change;
    return change;
  }
};

}  // namespace sphdrop
