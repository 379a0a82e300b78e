#include "contact/contact_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/contact_force.hpp"
#include "contact/foot_point.hpp"

namespace sphdrop {
namespace {

/// Saturates far outside any domain, so that a particle thrown there does not overflow the index.
std::int64_t cell_index(double coordinate, double cell_size) {
  constexpr double limit = 1e15;
  return static_cast<std::int64_t>(std::clamp(std::floor(coordinate / cell_size), -limit, limit));
}

/// Wide enough that a segment reaches only a few cells, even where one is far longer than the reach.
double contact_cell_size(const ContactSurface& surface, double reach) {
  double longest_extent = 0.0;
  for (const Segment& s : surface.segments) {
    const Vector extent = surface.vertex(s.second) - surface.vertex(s.first);
    longest_extent = std::max({longest_extent, std::abs(extent.x), std::abs(extent.y)});
  }
  return std::max(2.0 * reach, longest_extent / 16.0);
}

}  // namespace

void ContactSolver::rebuild(std::span<const double> particle_x, std::span<const double> particle_y,
                            std::span<const double> vertex_x, std::span<const double> vertex_y,
                            std::span<const Segment> segments, double reach) {
  assert(particle_x.size() == particle_y.size() && vertex_x.size() == vertex_y.size() && reach > 0.0);
  segments_.assign(segments.begin(), segments.end());
  cell_entries_.clear();
  active_particles_.clear();
  candidates_.clear();
  candidate_starts_.assign(1, 0);

  const ContactSurface surface{segments_, vertex_x, vertex_y};
  const double cell_size = contact_cell_size(surface, reach);
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Vector a = surface.vertex(segments_[k].first);
    const Vector b = surface.vertex(segments_[k].second);
    if (!std::isfinite(a.x + a.y + b.x + b.y)) continue;
    const auto last_column = cell_index(std::max(a.x, b.x) + reach, cell_size);
    const auto last_row = cell_index(std::max(a.y, b.y) + reach, cell_size);
    for (auto column = cell_index(std::min(a.x, b.x) - reach, cell_size); column <= last_column; ++column)
      for (auto row = cell_index(std::min(a.y, b.y) - reach, cell_size); row <= last_row; ++row)
        cell_entries_.push_back({column, row, static_cast<std::int32_t>(k)});
  }
  std::sort(cell_entries_.begin(), cell_entries_.end());

  for (std::size_t i = 0; i < particle_x.size(); ++i) {
    const Vector x{particle_x[i], particle_y[i]};
    if (!std::isfinite(x.x + x.y)) continue;
    const CellEntry cell{cell_index(x.x, cell_size), cell_index(x.y, cell_size), -1};
    for (auto entry = std::lower_bound(cell_entries_.begin(), cell_entries_.end(), cell);
         entry != cell_entries_.end() && entry->column == cell.column && entry->row == cell.row; ++entry) {
      const Segment& s = segments_[entry->segment];
      const auto projection = project_on_segment(x, surface.vertex(s.first), surface.vertex(s.second));
      if (projection.squared_distance <= reach * reach) candidates_.push_back(entry->segment);
    }
    if (static_cast<std::size_t>(candidate_starts_.back()) == candidates_.size()) continue;
    active_particles_.push_back(static_cast<std::int32_t>(i));
    candidate_starts_.push_back(static_cast<std::int32_t>(candidates_.size()));
  }
}

ContactSummary ContactSolver::apply(const ContactParticles& particles, const ContactVertices& vertices,
                                    const ContactParameters& parameters) const {
  const ContactSurface surface{segments_, vertices.x, vertices.y};
  const double d0 = parameters.contact_distance;
  ContactSummary summary;
  for (std::size_t a = 0; a < active_particles_.size(); ++a) {
    const std::int32_t i = active_particles_[a];
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
