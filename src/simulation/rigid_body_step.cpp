#include "simulation/rigid_body_step.hpp"

namespace sphdrop {

RigidBodyStep::RigidBodyStep(const Case& input, const InitialFluid& initial) : is_enabled_(input.drop.is_rigid()) {
  if (!is_enabled_) return;
  body_ = RigidBody(initial.as_body);
  body_.staggered_velocity = {input.drop.velocity_x, input.drop.velocity_y};
  body_.staggered_spin = input.drop.initial_spin;
}

void RigidBodyStep::take_places(FluidParticles& drop) const {
  drop.for_each_owned([&](std::size_t row) { drop.body_offset.set(row, drop.position.at(row) - body_.centre); });
}

void RigidBodyStep::predict(FluidParticles& drop, double previous_step) {
  body_.predict(previous_step);
  const Rotation turn = rotation_by(body_.angle);
  drop.for_each_owned([&](std::size_t row) {
    drop.velocity.set(row, rigid_velocity(body_.velocity, body_.spin, turn(drop.body_offset.at(row))));
    drop.density[row] = drop.staggered_density[row];
  });
}

void RigidBodyStep::accelerate(Vector force, double moment_about_origin, Vector gravity) {
  body_.accelerate(force, moment_about(body_.centre, force, moment_about_origin));
  body_.acceleration += gravity;
}

MotionMaxima RigidBodyStep::move(FluidParticles& drop, StepLengths steps, double speed_limit) {
  body_.kick_and_drift(steps.kick(), steps.next);
  const Rotation turn = rotation_by(body_.angle);
  drop.for_each_owned([&](std::size_t row) {
    const Vector from_centre = turn(drop.body_offset.at(row));
    drop.position.set(row, body_.centre + from_centre);
    drop.staggered_velocity.set(row, rigid_velocity(body_.staggered_velocity, body_.staggered_spin, from_centre));
  });
  return motion_maxima(drop, speed_limit);
}

std::vector<double> RigidBodyStep::to_numbers() const {
  return is_enabled_ ? body_.to_numbers() : std::vector<double>{};
}

void RigidBodyStep::from_numbers(std::span<const double> numbers) {
  if (is_enabled_) body_ = RigidBody::from_numbers(numbers);
}

}  // namespace sphdrop
