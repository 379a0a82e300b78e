#include "setup/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "contact/contact_solver.hpp"
#include "contact/contact_surface.hpp"
#include "setup/box.hpp"
#include "setup/polygon_geometry.hpp"
#include "setup/setup_error.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {
namespace {

// Particles looked at together: many enough that what is done once for them does not count.
constexpr std::size_t batch_size = 4096;

struct Coordinates {
  std::vector<double> x, y;

  void add(Vector place) {
    x.push_back(place.x);
    y.push_back(place.y);
  }
  void clear() {
    x.clear();
    y.clear();
  }
  std::size_t size() const { return x.size(); }
  Vector at(std::size_t k) const { return {x[k], y[k]}; }
};

/// Looks for particles of different drops that are nearer than `distance`, m. Add the particles that may be in
/// ascending order, those of the last drop left out.
class NearDrops {
 public:
  NearDrops(const std::vector<PlacedDrop>& drops, double distance) : drops_(drops), distance_(distance) {}

  /// Throws SetupError where some are.
  void add(std::size_t drop, Vector place) {
    batch_.add(place);
    drop_of_.push_back(drop);
    box_.include(place);
    if (batch_.size() == batch_size) look_at_batch();
  }
  void finish() { look_at_batch(); }

 private:
  /// Names the first particle that is too near to one of a later drop, and the first such drop.
  void look_at_batch() {
    if (batch_.size() == 0) return;
    const CellGrid grid(batch_.x, batch_.y, distance_);
    std::size_t first = batch_.size(), other = 0;
    for (std::size_t later = drop_of_.front() + 1; later < drops_.size(); ++later)
      drops_[later].for_each_in(box_.grown_by(distance_), [&](std::int64_t, Vector place, double) {
        grid.for_each_near(place, [&](std::int32_t near) {
          const auto k = static_cast<std::size_t>(near);
          if (k >= first || drop_of_[k] >= later || length(batch_.at(k) - place) >= distance_) return;
          first = k;
          other = later;
        });
      });
    if (first < batch_.size())
      throw SetupError(fmt::format(
          "the drops {} and {} overlap at the start, at x = {:.6g} m, y = {:.6g} m; move one of them (drop.centre_x, "
          "drop.centre_y), particles of different drops must be {:g} m apart",
          drop_of_[first] + 1, other + 1, batch_.x[first], batch_.y[first], distance_));
    batch_.clear();
    drop_of_.clear();
    box_ = {};
  }

  const std::vector<PlacedDrop>& drops_;
  double distance_;
  Coordinates batch_;
  std::vector<std::size_t> drop_of_;
  Box box_;
};

/// The contact surface with no vertices but those that its polylines use, in their old order, so that what is decided
/// by the lowest number is decided alike.
struct ContactLines {
  Coordinates places;
  std::vector<std::vector<std::int32_t>> polylines;

  explicit ContactLines(const InitialSolid& solid) : polylines(solid.contact_polylines) {
    std::vector<std::int32_t> used;
    for (const auto& polyline : polylines) used.insert(used.end(), polyline.begin(), polyline.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    places.x.resize(used.size());
    places.y.resize(used.size());
    for (std::size_t line = 0; line < polylines.size(); ++line)
      for (std::size_t k = 0; k < polylines[line].size(); ++k) {
        std::int32_t& vertex = polylines[line][k];
        const Vector place = solid.polyline_places.empty() ? place_of(vertex, solid) : solid.polyline_places[line][k];
        vertex = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), vertex) - used.begin());
        places.x[static_cast<std::size_t>(vertex)] = place.x;
        places.y[static_cast<std::size_t>(vertex)] = place.y;
      }
  }

 private:
  static Vector place_of(std::int32_t index, const InitialSolid& solid) {
    if (solid.contact_vertices.empty()) return solid.positions[static_cast<std::size_t>(index)];
    const ContactVertex& vertex = solid.contact_vertices[static_cast<std::size_t>(index)];
    Vector place;
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k)
      place += vertex.weight[k] * solid.positions[static_cast<std::size_t>(vertex.particle[k])];
    return place;
  }
};

/// Finds the particle that is deepest in the solid, of several the first.
class DeepestOverlap {
 public:
  DeepestOverlap(const ContactLines& lines, double contact_distance)
      : solid_(lines.places),
        segments_(segments_of_polylines(lines.polylines)),
        contact_distance_(contact_distance),
        force_x_(solid_.size()),
        force_y_(solid_.size()) {
    Box box;
    for (std::size_t k = 0; k < solid_.size(); ++k) box.include(solid_.at(k));
    // Far enough to find the boundary from anywhere inside the solid.
    reach_ = contact_distance + (box.high.y - box.low.y);
    within_reach_ = box.grown_by(reach_ * (1.0 + 1e-9));
  }

  /// Particles elsewhere need not be added.
  const Box& within_reach() const { return within_reach_; }

  void add(Vector place, double mass) {
    batch_.add(place);
    masses_.push_back(mass);
    if (batch_.size() == batch_size) look_at_batch();
  }
  void finish() { look_at_batch(); }

  double overlap() const { return overlap_; }
  Vector place() const { return place_; }

 private:
  void look_at_batch() {
    if (batch_.size() == 0) return;
    contact_.rebuild(batch_.x, batch_.y, solid_.x, solid_.y, segments_, reach_);
    unused_x_.resize(batch_.size());
    unused_y_.resize(batch_.size());
    const ContactSummary found =
        contact_.apply({batch_.x, batch_.y, masses_, unused_x_, unused_y_}, {solid_.x, solid_.y, force_x_, force_y_},
                       {1.0, contact_distance_, 0.0});
    if (found.largest_overlap > overlap_) {
      overlap_ = found.largest_overlap;
      const auto deepest = static_cast<std::size_t>(found.deepest);
      place_ = batch_.at(deepest);
    }
    batch_.clear();
    masses_.clear();
  }

  Coordinates solid_, batch_;
  std::vector<Segment> segments_;
  double contact_distance_, reach_;
  Box within_reach_;
  std::vector<double> masses_, force_x_, force_y_, unused_x_, unused_y_;
  ContactSolver contact_;
  double overlap_ = 0;
  Vector place_;
};

std::string advice_on_overlap(const Case& input, Vector centre) {
  switch (input.drop.placement) {
    case DropPlacement::file:
      return "move the drop away by at least that much in its file, or by drop.placement = \"centre\" with "
             "drop.centre_x and drop.centre_y; drop.placement = \"above_solid\" puts it above the solid";
    case DropPlacement::above_solid:
      return fmt::format(
          "make drop.gap (now {:g} m) larger by at least that much, or move the drop (drop.centre_x, now {:g} m) off "
          "the clamps",
          input.drop.gap, centre.x);
    case DropPlacement::centre:
      break;
  }
  return fmt::format(
      "move the drop away by at least that much (drop.centre_x, drop.centre_y, now {:g} m and {:g} m), or leave "
      "out drop.placement, which puts it above the solid",
      centre.x, centre.y);
}

}  // namespace

void refuse_too_many_particles(const Case& input) {
  // Rows of a process and particles of the solid are numbered in 32 bits; a slipped decimal point in the spacing should
  // say so.
  constexpr double limit = 1e8;
  const double d = input.resolution.spacing;
  double count = 0.0;
  for (std::size_t k = 0; k < input.drop_count(); ++k) {
    const Case::Drop drop = input.with_drop(k).drop;
    if (drop.shape != DropShape::none) count += (drop.diameter / d) * (drop.diameter / d);
  }
  for (std::size_t k = 0; k < input.solid_count(); ++k) {
    const Case::Solid& solid = input.solid_at(k);
    const double length = solid.length / d;
    if (solid.kind == SolidKind::rigid_wall) count += length;
    if (solid.is_straight_beam())
      count += (length + 2.0 * solid.clamp_length / d) *
               (solid.thickness / d + 2.0 * static_cast<double>(solid.clamp_layers));
    if (solid.kind == SolidKind::polygon) count += std::abs(signed_area(counterclockwise_polygon(solid.polygon, d)));
  }
  if (count <= limit) return;
  throw SetupError(fmt::format(
      "a spacing of {:g} m makes about {:.2g} particles; at most {:.2g} can be set up: choose a larger spacing", d,
      count, limit));
}

void refuse_overlapping_drops(const std::vector<PlacedDrop>& drops, double spacing) {
  const double nearest_allowed = 0.7 * spacing;
  NearDrops near(drops, nearest_allowed);
  for (std::size_t drop = 0; drop + 1 < drops.size(); ++drop) {
    const std::span later(drops.begin() + static_cast<std::ptrdiff_t>(drop) + 1, drops.end());
    Box box;
    for (const PlacedDrop& other : later) box.include(other.bounds().grown_by(nearest_allowed));
    drops[drop].for_each_in(box, [&](std::int64_t, Vector place, double) {
      const auto is_near = [&](const PlacedDrop& other) { return other.is_near(place, nearest_allowed); };
      if (std::any_of(later.begin(), later.end(), is_near)) near.add(drop, place);
    });
  }
  near.finish();
}

void refuse_overlap(const Case& input, const std::vector<PlacedDrop>& drops, const InitialSolid& solid, Vector centre) {
  const double d = input.resolution.spacing;
  const double contact_distance = input.contact.distance_ratio * d;
  if (drops.empty() || solid.contact_polylines.empty() || !(contact_distance > 0.0)) return;
  DeepestOverlap deepest(ContactLines(solid), contact_distance);
  for (const PlacedDrop& drop : drops)
    drop.for_each_in(deepest.within_reach(),
                     [&](std::int64_t, Vector place, double mass) { deepest.add(place, mass); });
  deepest.finish();
  if (deepest.overlap() <= 1e-6 * d) return;
  throw SetupError(fmt::format(
      "the drop overlaps the solid at the start: the particle at x = {:.6g} m, y = {:.6g} m is nearer to "
      "the solid than the contact distance of {:g} m by {:.3g} m and would be shot away; {}",
      deepest.place().x, deepest.place().y, contact_distance, deepest.overlap(), advice_on_overlap(input, centre)));
}

}  // namespace sphdrop
