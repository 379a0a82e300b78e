#pragma once
// Kick-drift leap-frog with predicted rates (Eqs 36-39; Liu & Liu 2003).
//
// Between steps density, velocity and deviatoric stress belong to t - dt/2 ("staggered"), position to t. A step
// predicts them at t, evaluates the rates there, kicks the staggered values to t + dt/2 and drifts position to t + dt.
// Before the first step the staggered values are those at t = 0: with previous step 0, predict() copies and kick()
// takes half a step.

#include <algorithm>
#include <functional>
#include <limits>
#include <span>

#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"

namespace sphdrop {

/// Lengths of the step before and of the step to take, s.
struct StepLengths {
  double previous = 0;
  double next = 0;
  /// From t - previous/2 to t + next/2.
  double kick() const { return 0.5 * (previous + next); }
};

/// The smallest rectangle that holds the displacements of all particles, m: what they have in common moves it and does
/// not widen it. Of no particles it is empty.
struct DisplacementBox {
  double low_x = std::numeric_limits<double>::infinity(), high_x = -low_x;
  double low_y = low_x, high_y = -low_x;

  /// Of the diagonal: no two displacements differ by more, m2.
  double squared_diagonal() const {
    const double x = high_x - low_x, y = high_y - low_y;
    return x * x + y * y;
  }
  /// Bound of what any particle has moved since its displacement was in the box `earlier`, m2.
  double squared_motion_since(const DisplacementBox& earlier) const {
    const double x = std::max(high_x - earlier.low_x, earlier.high_x - low_x);
    const double y = std::max(high_y - earlier.low_y, earlier.high_y - low_y);
    return x * x + y * y;
  }
};

/// What a step does to the fastest and the farthest-moved particle; maxima over owned rows, squared: m2/s2, m2.
struct MotionMaxima {
  double squared_speed = 0;
  double squared_displacement = 0;                             ///< from list_position
  double squared_detection_displacement = 0;                   ///< from detection_position (liquid)
  DisplacementBox displacements{}, detection_displacements{};  ///< from the same positions (liquid)
  /// A particle is faster than allowed, or its velocity is not a number.
  bool beyond_limit = false;
};

/// Which boxes to look for; the others stay empty.
struct BoxesWanted {
  bool displacements = false, detection_displacements = false;
};

/// Of the staggered velocity and the position as they stand. `speed_limit` in m/s.
MotionMaxima motion_maxima(const FluidParticles& fluid, double speed_limit, BoxesWanted boxes = {});

/// Velocity and density (and deviatoric stress) of the owned rows at t from the staggered ones.
void predict(FluidParticles& fluid, double previous_step);
void predict(SolidParticles& solid, double previous_step);
/// The same of some rows.
void predict(FluidParticles& fluid, std::span<const RowRange> rows, double previous_step);
void predict(SolidParticles& solid, std::span<const RowRange> rows, double previous_step);

/// Velocity alone, of a solid whose stress follows from its position.
void predict_velocity(SolidParticles& solid, double previous_step);

/// Velocity, density (and deviatoric stress) from t - previous/2 to t + next/2, position from t to t + next (36-39);
/// held particles (is_fixed 1) stay. `speed_limit` in m/s.
MotionMaxima kick_and_drift(FluidParticles& fluid, StepLengths steps, double speed_limit, BoxesWanted boxes = {});
MotionMaxima kick_and_drift(SolidParticles& solid, StepLengths steps, double speed_limit);
/// With `then` done to each run of rows once it has moved, while its columns are still in the cache.
MotionMaxima kick_and_drift(SolidParticles& solid, StepLengths steps, double speed_limit,
                            const std::function<void(std::span<const RowRange>)>& then);

/// The same for a solid whose stress follows from its position: velocity and position, and if `is_heated` the
/// dissipated energy.
MotionMaxima kick_and_drift_velocity(SolidParticles& solid, StepLengths steps, double speed_limit, bool is_heated);

}  // namespace sphdrop
