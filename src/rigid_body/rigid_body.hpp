#pragma once
// A rigid body of the plane and its motion (Sec. 4.4): Newton's and Euler's laws, leap-frog (Eqs 36-39).

#include <cstddef>
#include <span>
#include <vector>

#include "particles/vector.hpp"
#include "rigid_body/mass_properties.hpp"

namespace sphdrop {

/// A rotation of the plane about the origin, counterclockwise.
struct Rotation {
  double cosine = 1, sine = 0;

  constexpr Vector operator()(Vector a) const { return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y}; }
};

/// By `angle` in radians, whole turns included. The same bits on every machine.
Rotation rotation_by(double angle);

/// Velocity of the point at `from_centre` (m) of a body that moves at `velocity` (m/s) and turns at `spin` (rad/s).
constexpr Vector rigid_velocity(Vector velocity, double spin, Vector from_centre) {
  return velocity + spin * left_normal(from_centre);
}

/// The moment about `centre` of a force whose moment about the origin is known, N m per metre of depth.
constexpr double moment_about(Vector centre, Vector force, double moment_about_origin) {
  return moment_about_origin - cross(centre, force);
}

/// The state of a rigid body per metre of depth, in SI units and radians. As for particles, place and angle belong to
/// t, "staggered" values to t - dt/2; before the first step these are the values at t = 0.
struct RigidBody {
  double mass = 0, moment_of_inertia = 0;
  Vector centre;
  double angle = 0;
  Vector staggered_velocity;
  double staggered_spin = 0;
  /// Of the step last evaluated, with which predict() goes on from the staggered values.
  Vector acceleration;
  double angular_acceleration = 0;
  /// At t.
  Vector velocity;
  double spin = 0;

  /// At rest at angle 0.
  RigidBody() = default;
  explicit RigidBody(const MassProperties& properties)
      : mass(properties.mass), moment_of_inertia(properties.moment_of_inertia), centre(properties.centre) {}

  /// Velocity and spin at t, half of the `previous_step` (s) after the staggered ones.
  void predict(double previous_step);
  /// The accelerations under `force` (N/m) at the mass centre and `moment` (N m/m) about it. A body that is one point
  /// does not turn.
  void accelerate(Vector force, double moment);
  /// Velocity and spin over `kick`, from t - dt/2 to t + dt/2, then place and angle over the `step` to t + dt, both in
  /// s (36-39).
  void kick_and_drift(double kick, double step);

  /// All there is to it as plain numbers, for a checkpoint.
  std::vector<double> to_numbers() const;
  /// The body that gave these numbers, bit for bit. Throws std::invalid_argument where none can have given them.
  static RigidBody from_numbers(std::span<const double> numbers);
  friend bool operator==(const RigidBody&, const RigidBody&) = default;
};

}  // namespace sphdrop
