#pragma once
// The stable time step (Eqs 40-42).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sphdrop {

struct TimeStepLimits {
  double sound_cfl = 0.1;       ///< factor of (40)
  double capillary_cfl = 0.1;   ///< factor of (41)
  double viscous_cfl = 0.1;     ///< factor of (42)
  double smoothing_length = 0;  ///< h, m
  double sound_speed = 0;       ///< c = max(c_f, c_s), m/s
  double density = 0;           ///< rho of the liquid, kg/m3
  double surface_tension = 0;   ///< sigma, N/m; 0 lifts (41)
  double viscosity = 0;         ///< mu, Pa s; 0 lifts (42)
  double viscous_time = 0;      ///< of a solid with stiffness-proportional damping, s
  /// Of the solid in a step. If there are several, sound_speed is the solid's alone, and (40) of the sub-steps and of
  /// the liquid with factor and sound speed of its own are what counts.
  double solid_substeps = 1;
  double liquid_sound_cfl = 0;
  double liquid_sound_speed = 0;  ///< m/s
};

/// 0.1 h/(c + u_max), s (40). Stiffness-proportional damping shortens it by sqrt(1 + z^2) - z (Belytschko, Liu & Moran
/// 2000, 6.2.3), where z = viscous_time omega, with omega about 4 c/h, is twice the damping ratio of the fastest mode:
/// the predicted velocity, from which the damping is computed, halves what such a step stands.
inline double acoustic_time_step(const TimeStepLimits& l, double largest_speed) {
  const double step = l.sound_cfl * l.smoothing_length / (l.sound_speed + largest_speed);
  if (l.viscous_time <= 0) return step;
  const double ratio = 4.0 * l.viscous_time * l.sound_speed / l.smoothing_length;
  return step / (std::sqrt(1.0 + ratio * ratio) + ratio);
}
/// 0.1 sqrt(rho h^3/(2 pi sigma)), s (41).
inline double capillary_time_step(const TimeStepLimits& l) {
  if (l.surface_tension <= 0) return std::numeric_limits<double>::infinity();
  const double h = l.smoothing_length;
  return l.capillary_cfl * std::sqrt(l.density * (h * h * h) / (2.0 * std::numbers::pi * l.surface_tension));
}
/// 0.1 rho h^2/mu, s (42).
inline double viscous_time_step(const TimeStepLimits& l) {
  if (l.viscosity <= 0) return std::numeric_limits<double>::infinity();
  return l.viscous_cfl * l.density * (l.smoothing_length * l.smoothing_length) / l.viscosity;
}
/// (40) of a solid that takes sub-steps and of the liquid that waits for it, s; without sub-steps of both together.
inline double sound_time_step(const TimeStepLimits& l, double largest_speed) {
  const double step = acoustic_time_step(l, largest_speed);
  if (l.solid_substeps <= 1) return step;
  return std::min(l.solid_substeps * step,
                  l.liquid_sound_cfl * l.smoothing_length / (l.liquid_sound_speed + largest_speed));
}
/// The smallest of the three, s.
inline double stable_time_step(const TimeStepLimits& l, double largest_speed) {
  return std::min({sound_time_step(l, largest_speed), capillary_time_step(l), viscous_time_step(l)});
}

}  // namespace sphdrop
