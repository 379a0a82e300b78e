// The solid's steps within one of the liquid's (method.md, 4).

#include <algorithm>

#include "simulation/particle_transport.hpp"
#include "simulation/simulation.hpp"
#include "solid/mass_proportional_damping.hpp"

namespace sphdrop {

// The first sub-step starts from what evaluate() found, and takes the contact's impulse over the whole step: an impulse
// now and then is a force that depends on positions alone, as all of leap-frog's forces do.
MotionMaxima Simulation::move_solid_in_substeps(double speed_limit) {
  const auto substeps = static_cast<double>(case_.time.solid_substeps);
  StepLengths lengths{steps_.previous / substeps, steps_.next / substeps};
  contact_.kick_solid(solid_, steps_.kick());
  supports_.stop(solid_);
  MotionMaxima maxima = solid_step_->move(solid_, lengths, speed_limit);
  for (std::int64_t substep = 1; substep < case_.time.solid_substeps; ++substep) {
    timer_.lap(Phase::update);
    lengths.previous = lengths.next;
    evaluate_solid(lengths.previous);
    supports_.stop(solid_);
    if (!inversion_) inversion_ = solid_step_->inversion(solid_);
    const MotionMaxima present = solid_step_->move(solid_, lengths, speed_limit);
    maxima.squared_speed = std::max(maxima.squared_speed, present.squared_speed);
    maxima.squared_displacement = present.squared_displacement;
    maxima.beyond_limit = maxima.beyond_limit || present.beyond_limit;
  }
  return maxima;
}

// What the solid does to itself, and gravity: all that changes within a step of the liquid.
void Simulation::evaluate_solid(double previous_step) {
  solid_step_->predict(solid_, previous_step);
  timer_.lap(Phase::update);
  start_exchange(distribution_.solid_halo(), solid_ghosted_);
  timer_.lap(Phase::communication);
  solid_step_->sweep_inner(solid_, distribution_);
  timer_.lap(Phase::solid_sweep);
  finish_exchange(distribution_.solid_halo(), solid_ghosted_);
  timer_.lap(Phase::communication);
  solid_step_->sweep_rest(solid_, distribution_);
  timer_.lap(Phase::solid_sweep);
  if (!is_relaxing()) add_gravity(solid_, solid_.acceleration);
  damp_solids();
}

}  // namespace sphdrop
