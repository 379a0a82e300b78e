#include "contact/contact_solver.hpp"

#include <cassert>

#include "contact/contact_force.hpp"
#include "contact/foot_point.hpp"

namespace sphdrop {

void ContactSolver::rebuild(std::span<const double> particle_x, std::span<const double> particle_y,
                            std::span<const double> vertex_x, std::span<const double> vertex_y,
                            std::span<const Segment> segments, double reach) {
  assert(particle_x.size() == particle_y.size() && vertex_x.size() == vertex_y.size() && reach > 0.0);
  segments_.assign(segments.begin(), segments.end());
  search_.rebuild(particle_x, particle_y, {segments_, vertex_x, vertex_y}, reach);
}

ContactSummary ContactSolver::apply(const ContactParticles& particles, const ContactVertices& vertices,
                                    const ContactParameters& parameters) const {
  const ContactSurface surface{segments_, vertices.x, vertices.y};
  const double d0 = parameters.contact_distance;
  ContactSummary summary;
  const std::span<const std::int32_t> active = search_.active_points();
  for (std::size_t a = 0; a < active.size(); ++a) {
    const std::int32_t i = active[a];
    const FootPoint foot = nearest_foot_point({particles.x[i], particles.y[i]}, candidates(a), surface);
    const double overlap = d0 - foot.distance;
    if (!(overlap > 0.0)) continue;

    const double k = parameters.rate(particles.mass[i]);
    Vector f = contact_acceleration(foot, k, d0);  // Eq 24
    const Segment& s = segments_[foot.segment];
    SharedForce couple;
    if (parameters.resists_motion()) {
      const Vector velocity_of_first{vertices.velocity_x[s.first], vertices.velocity_y[s.first]};
      const Vector velocity_of_second{vertices.velocity_x[s.second], vertices.velocity_y[s.second]};
      const Vector of_foot = velocity_of_first + foot.fraction * (velocity_of_second - velocity_of_first);
      const Vector relative = Vector{particles.velocity_x[i], particles.velocity_y[i]} - of_foot;
      const Vector drag = wall_drag(foot, parameters.drag_rate, relative);
      const Vector resistance = contact_damping(foot, k, d0, parameters.damping_ratio, relative) + drag;
      f += resistance;
      summary.dissipation -= particles.mass[i] * dot(resistance, relative);
      // Drag acts on the particle, a distance d_p from where the boundary takes it.
      if (!foot.at_vertex)
        couple = shared_moment(-particles.mass[i] * foot.distance * cross(foot.normal, drag), surface.vertex(s.first),
                               surface.vertex(s.second));
    }
    particles.acceleration_x[i] += f.x;
    particles.acceleration_y[i] += f.y;

    const Vector reaction = -particles.mass[i] * f;
    const SharedForce share = shared_force(reaction, foot.fraction);  // Eq 26
    vertices.force_x[s.first] += share.first.x;
    vertices.force_y[s.first] += share.first.y;
    vertices.force_x[s.second] += share.second.x;
    vertices.force_y[s.second] += share.second.y;

    if (parameters.drag_rate > 0.0) {
      vertices.force_x[s.first] += couple.first.x;
      vertices.force_y[s.first] += couple.first.y;
      vertices.force_x[s.second] += couple.second.x;
      vertices.force_y[s.second] += couple.second.y;
    }

    ++summary.count;
    summary.force_on_solid += reaction;
    summary.moment_on_solid += cross({particles.x[i], particles.y[i]}, reaction);
    summary.energy += particles.mass[i] * contact_energy(foot, k, d0);
    if (overlap > summary.largest_overlap) {
      summary.largest_overlap = overlap;
      summary.deepest = i;
    }
  }
  return summary;
}

}  // namespace sphdrop
