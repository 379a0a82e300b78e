#include "rigid_body/rigid_body.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "particles/elementary_functions.hpp"

namespace sphdrop {

Rotation rotation_by(double angle) {
  // The remainder is exact, so it keeps the bits' promise and lets a ball turn for ever.
  const SineCosine direction = sine_cosine(std::fmod(angle, 2.0 * std::numbers::pi));
  return {direction.cosine, direction.sine};
}

void RigidBody::predict(double previous_step) {
  velocity = staggered_velocity + 0.5 * previous_step * acceleration;
  spin = staggered_spin + 0.5 * previous_step * angular_acceleration;
}

void RigidBody::accelerate(Vector force, double moment) {
  acceleration = force / mass;
  angular_acceleration = moment_of_inertia > 0 ? moment / moment_of_inertia : 0.0;
}

void RigidBody::kick_and_drift(double kick, double step) {
  staggered_velocity += kick * acceleration;
  staggered_spin += kick * angular_acceleration;
  centre += step * staggered_velocity;
  angle += step * staggered_spin;
}

std::vector<double> RigidBody::to_numbers() const {
  return {mass,
          moment_of_inertia,
          centre.x,
          centre.y,
          angle,
          staggered_velocity.x,
          staggered_velocity.y,
          staggered_spin,
          acceleration.x,
          acceleration.y,
          angular_acceleration,
          velocity.x,
          velocity.y,
          spin};
}

RigidBody RigidBody::from_numbers(std::span<const double> numbers) {
  constexpr std::size_t count = 14;
  if (numbers.size() != count) throw std::invalid_argument("a rigid body is told by 14 numbers");
  if (!(numbers[0] > 0.0) || !(numbers[1] >= 0.0))
    throw std::invalid_argument("a rigid body's mass and moment of inertia must be positive");
  RigidBody body;
  body.mass = numbers[0];
  body.moment_of_inertia = numbers[1];
  body.centre = {numbers[2], numbers[3]};
  body.angle = numbers[4];
  body.staggered_velocity = {numbers[5], numbers[6]};
  body.staggered_spin = numbers[7];
  body.acceleration = {numbers[8], numbers[9]};
  body.angular_acceleration = numbers[10];
  body.velocity = {numbers[11], numbers[12]};
  body.spin = numbers[13];
  return body;
}

}  // namespace sphdrop
