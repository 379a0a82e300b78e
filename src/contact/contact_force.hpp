#pragma once
// The repulsion between liquid and solid and how the solid's boundary takes it (Sec. 2.4, Eqs 24 and 26).

#include "contact/foot_point.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// k, 1/s2, the contact spring's rate per mass of the particle, after Eq 24: `stiffness` (0.1) over the square of the
/// time step (s).
constexpr double time_step_spring_rate(double stiffness, double time_step) {
  return stiffness / (time_step * time_step);
}

/// f = k (d0 - d_p) n, m/s2, for d_p < d0, otherwise none (Eq 24). `spring_rate` k in 1/s2, `contact_distance` d0 in m.
constexpr Vector contact_acceleration(const FootPoint& foot, double spring_rate, double contact_distance) {
  const double overlap = contact_distance - foot.distance;
  return overlap > 0.0 ? (spring_rate * overlap) * foot.normal : Vector{};
}

/// The energy k (d0 - d_p)^2 / 2 stored in the spring per mass of the particle, J/kg.
constexpr double contact_energy(const FootPoint& foot, double spring_rate, double contact_distance) {
  const double overlap = contact_distance - foot.distance;
  return overlap > 0.0 ? 0.5 * spring_rate * overlap * overlap : 0.0;
}

/// What the two ends of a segment take of a force, N per metre of depth.
struct SharedForce {
  Vector first, second;
};

/// F1 + F2 = F and F1 S1 = F2 S2, S1 and S2 the distances from the foot point to the ends: the nearer end takes the
/// larger share, and force and moment are those of F at the foot point (Eq 26). At a vertex, fraction 0 or 1, it takes
/// all.
constexpr SharedForce shared_force(Vector force, double fraction) {
  const Vector second = fraction * force;
  return {force - second, second};
}

}  // namespace sphdrop
