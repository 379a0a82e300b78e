#pragma once
// The repulsion between liquid and solid and how the solid's boundary takes it (Sec. 2.4, Eqs 24 and 26).

#include <algorithm>
#include <cmath>

#include "contact/foot_point.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// k, 1/s2, the contact spring's rate per mass of the particle, after Eq 24: `stiffness` (0.1) over the square of the
/// time step (s).
constexpr double time_step_spring_rate(double stiffness, double time_step) {
  return stiffness / (time_step * time_step);
}

/// k, 1/s2, of a spring whose stiffness does not depend on the time step. `stiffness` k_n in N/m per metre of depth
/// (Pa), `mass` of the particle in kg/m: the force per metre of depth is k_n (d0 - d_p), its acceleration that over m.
/// A layer of liquid under the pressure p, a force p d on each particle, is pushed in by p d/k_n.
constexpr double fixed_spring_rate(double stiffness, double mass) {
  return stiffness / mass;
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

/// The damper beside the spring, m/s2: -2 zeta sqrt(k) v_n n, with v_n the particle's normal velocity (m/s) relative to
/// the boundary at the foot point. zeta = 1 is critical for the particle on a boundary held fast. Spring and damper
/// together never pull: as the particle leaves, the damper takes no more than the spring gives.
inline Vector contact_damping(const FootPoint& foot, double spring_rate, double contact_distance, double damping_ratio,
                              Vector relative_velocity) {
  const double overlap = contact_distance - foot.distance;
  if (!(overlap > 0.0)) return {};
  const double along_normal = -2.0 * damping_ratio * std::sqrt(spring_rate) * dot(relative_velocity, foot.normal);
  return std::max(along_normal, -spring_rate * overlap) * foot.normal;
}

/// The drag of the wall on a particle in contact, m/s2: -`drag_rate` (1/s) times its velocity along the wall (m/s).
/// None past a vertex, which has no tangent.
constexpr Vector wall_drag(const FootPoint& foot, double drag_rate, Vector relative_velocity) {
  if (foot.at_vertex) return {};
  return -drag_rate * (relative_velocity - dot(relative_velocity, foot.normal) * foot.normal);
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

/// A pair of opposite forces across the segment from `first` to `second` with this counterclockwise moment, N m per
/// metre of depth.
inline SharedForce shared_moment(double moment, Vector first, Vector second) {
  const Vector direction = second - first;
  const Vector on_second = (moment / squared_length(direction)) * left_normal(direction);
  return {-on_second, on_second};
}

}  // namespace sphdrop
