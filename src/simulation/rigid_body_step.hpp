#pragma once
// A drop that moves as one rigid body (Sec. 4.4): the body's state, the same bits on every rank, and its particles.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "particles/fluid_particles.hpp"
#include "rigid_body/rigid_body.hpp"
#include "setup/initial_particles.hpp"
#include "time_integration/leapfrog.hpp"

namespace sphdrop {

/// In a step: predict(), accelerate(), move(). The body is on every rank, its particles are anywhere; each knows its
/// place in the body and gets position and velocity from there anew, so that the body never deforms.
class RigidBodyStep {
 public:
  /// Does nothing for a liquid drop.
  RigidBodyStep(const Case& input, const InitialFluid& initial);

  bool is_enabled() const { return is_enabled_; }
  const RigidBody& body() const { return body_; }

  /// Gives the owned particles, still where they start, their places in the body.
  void take_places(FluidParticles& drop) const;
  /// The body's velocity and spin at the present instant, and the owned particles' velocities.
  void predict(FluidParticles& drop, double previous_step);
  /// `force` on the body, N/m, and its moment about the origin, N m/m; `gravity` in m/s2.
  void accelerate(Vector force, double moment_about_origin, Vector gravity);
  /// Kick and drift (Eqs 36-39) of the body, and the owned particles' positions and staggered velocities.
  MotionMaxima move(FluidParticles& drop, StepLengths steps, double speed_limit);

  /// The body's state; none for a liquid drop.
  std::vector<double> to_numbers() const;
  /// Throws std::invalid_argument where the numbers are not of to_numbers().
  void from_numbers(std::span<const double> numbers);

 private:
  bool is_enabled_;
  RigidBody body_;
};

}  // namespace sphdrop
