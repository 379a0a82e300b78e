#pragma once
// Contact between liquid particles and the solid's boundary (Sec. 2.4): search now and then, forces every step.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_force.hpp"
#include "contact/contact_surface.hpp"
#include "contact/segment_search.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

struct ContactParameters {
  double spring_rate = 0;       ///< k, 1/s2: acceleration per overlap; Eq 24: time_step_spring_rate()
  double contact_distance = 0;  ///< d0, m
  double overlap_limit = 0;     ///< largest overlap d0 - d_p that is still sound, in units of d0
  double spring_stiffness = 0;  ///< k_n, Pa: where it is not zero, k = k_n/m instead (fixed_spring_rate())
  double damping_ratio = 0;     ///< of contact_damping()
  double drag_rate = 0;         ///< of wall_drag(), 1/s

  double rate(double mass) const {
    return spring_stiffness > 0.0 ? fixed_spring_rate(spring_stiffness, mass) : spring_rate;
  }
  /// Whether any force depends on velocities.
  bool resists_motion() const { return damping_ratio > 0.0 || drag_rate > 0.0; }
};

/// Liquid particles in ascending order of their global id (shapes: [particles]; m, kg per metre of depth, m/s2).
struct ContactParticles {
  std::span<const double> x, y, mass;
  std::span<double> acceleration_x, acceleration_y;    ///< added to
  std::span<const double> velocity_x{}, velocity_y{};  ///< m/s; read where the parameters resist motion
};

/// The boundary's vertices (shapes: [vertices]; m, N per metre of depth).
struct ContactVertices {
  std::span<const double> x, y;
  std::span<double> force_x, force_y;                  ///< added to
  std::span<const double> velocity_x{}, velocity_y{};  ///< m/s; read where the parameters resist motion
};

/// What happened in one step. Sums run over the particles in ascending order.
struct ContactSummary {
  std::int64_t count = 0;      ///< particles in contact
  Vector force_on_solid;       ///< N per metre of depth
  double moment_on_solid = 0;  ///< of that force about the origin, counterclockwise, N m per metre of depth
  double energy = 0;           ///< sum of m k (d0 - d_p)^2 / 2, J per metre of depth
  double dissipation = 0;      ///< power that dampers and drag turn into heat, W per metre of depth
  double largest_overlap = 0;  ///< largest d0 - d_p, m
  std::int32_t deepest = -1;   ///< the particle it belongs to, the lowest of several; -1 without contact

  bool overlap_is_too_deep(const ContactParameters& parameters) const {
    return largest_overlap > parameters.overlap_limit * parameters.contact_distance;
  }
};

/// Candidates found by rebuild() stay valid while no particle has come nearer to a segment by more than `reach` less
/// the contact distance.
class ContactSolver {
 public:
  /// Finds for every particle the segments within `reach` (m) of it. Shapes: [particles], [vertices]; positions in m.
  void rebuild(std::span<const double> particle_x, std::span<const double> particle_y, std::span<const double> vertex_x,
               std::span<const double> vertex_y, std::span<const Segment> segments, double reach);

  /// Adds the repulsion of Eq 24 to the particles and its reaction, shared after Eq 26, to the vertices. The arrays are
  /// those of the last rebuild(), moved since. Allocates nothing.
  ContactSummary apply(const ContactParticles& particles, const ContactVertices& vertices,
                       const ContactParameters& parameters) const;

  /// The particles that have any candidate, ascending.
  std::span<const std::int32_t> active_particles() const { return search_.active_points(); }
  /// The segments within reach of the k-th active particle, ascending.
  std::span<const std::int32_t> candidates(std::size_t k) const { return search_.candidates(k); }
  std::span<const Segment> segments() const { return segments_; }

 private:
  std::vector<Segment> segments_;
  SegmentSearch search_;
};

}  // namespace sphdrop
