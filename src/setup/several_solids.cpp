#include "setup/several_solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "setup/box.hpp"
#include "setup/polygon_geometry.hpp"
#include "setup/setup_error.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How low a solid lets particles come that stay `clearance` (m) off it.
class Obstruction {
 public:
  Obstruction(const InitialSolid& solid, double clearance) : solid_(solid), clearance_(clearance) {
    for (const Vector& corner : solid.outline) box_.include(corner);
    if (solid.outline.empty()) {
      for (const Vector& p : solid.positions) columns_.push_back(p.x);
      std::sort(columns_.begin(), columns_.end());
      columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
      if (!columns_.empty()) box_ = {{columns_.front(), -infinity}, {columns_.back(), solid.top}};
    }
    box_ = box_.grown_by(clearance * (1.0 + 1e-6));
  }

  /// Particles elsewhere are free.
  const Box& box() const { return box_; }

  /// Minus infinity where the solid does not reach there.
  double highest_between(double left, double right) const {
    if (solid_.outline.empty()) {
      const auto column = std::lower_bound(columns_.begin(), columns_.end(), left);
      return column != columns_.end() && *column <= right ? solid_.top : -infinity;
    }
    double highest = -infinity;
    std::vector<Vector> part;
    clip_in_x(solid_.outline, left, right, part);
    for (const Vector& p : part) highest = std::max(highest, p.y);
    return highest;
  }

  bool is_free(Vector place) const {
    if (solid_.outline.empty())
      return place.y - clearance_ >= solid_.top ||
             highest_between(place.x - clearance_, place.x + clearance_) < solid_.top;
    return !contains(solid_.outline, place) && distance_to_border(solid_.outline, place) >= clearance_;
  }

 private:
  const InitialSolid& solid_;
  double clearance_;
  std::vector<double> columns_;  // x of a beam's or wall's particles, ascending
  Box box_;
};

template <class T>
void append(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<std::int32_t> shifted(const std::vector<std::int32_t>& indices, std::int32_t by) {
  std::vector<std::int32_t> result;
  result.reserve(indices.size());
  for (const std::int32_t k : indices) result.push_back(k + by);
  return result;
}

}  // namespace

void move_body(InitialSolid& body, Vector shift) {
  if (shift == Vector{}) return;
  for (Vector& position : body.positions) position += shift;
  for (Vector& corner : body.outline) corner += shift;
  for (std::vector<Vector>& places : body.polyline_places)
    for (Vector& place : places) place += shift;
  body.bounds = body.bounds.moved_by(shift);
  body.top += shift.y;
}

InitialSolid joined_solids(const std::vector<InitialSolid>& solids) {
  if (solids.size() == 1) return solids.front();
  InitialSolid all;
  all.top = -infinity;
  for (const InitialSolid& one : solids) {
    const auto first = static_cast<std::int32_t>(all.positions.size());
    const auto first_vertex = static_cast<std::int32_t>(all.contact_vertices.size());
    append(one.positions, all.positions);
    append(one.velocities, all.velocities);
    append(one.masses, all.masses);
    append(one.is_fixed, all.is_fixed);
    for (const auto& polyline : one.contact_polylines) all.contact_polylines.push_back(shifted(polyline, first_vertex));
    for (ContactVertex vertex : one.contact_vertices) {
      for (std::int32_t k = 0; k < vertex.count; ++k) vertex.particle[static_cast<std::size_t>(k)] += first;
      all.contact_vertices.push_back(vertex);
    }
    if (one.contact_vertices.empty())
      for (std::size_t k = 0; k < one.positions.size(); ++k)
        all.contact_vertices.push_back(ContactVertex::at_particle(first + static_cast<std::int32_t>(k)));
    append(one.quadrants, all.quadrants);
    if (one.quadrants.empty()) all.quadrants.resize(all.positions.size());
    for (const Hold& hold : one.holds) all.holds.push_back({hold.particle + first, hold.in_x, hold.in_y});
    all.mobile_count += one.mobile_count;
    all.top = std::max(all.top, one.top);
    all.bodies.push_back({first, static_cast<std::int32_t>(all.positions.size()), shifted(one.deflection_probe, first),
                          shifted(one.middle_probe, first)});
  }
  all.deflection_probe = all.bodies.front().deflection_probe;
  all.middle_probe = all.bodies.front().middle_probe;
  return all;
}

void refuse_near_solids(const InitialSolid& all, double distance) {
  if (all.bodies.size() < 2) return;
  std::vector<double> x, y;
  for (const Vector& position : all.positions) {
    x.push_back(position.x);
    y.push_back(position.y);
  }
  const CellGrid grid(x, y, distance);
  for (std::size_t b = 1; b < all.bodies.size(); ++b)
    for (std::int32_t i = all.bodies[b].begin; i < all.bodies[b].end; ++i) {
      const Vector here = all.positions[static_cast<std::size_t>(i)];
      grid.for_each_near(here, [&](std::int32_t j) {
        if (j >= all.bodies[b].begin || length(here - all.positions[static_cast<std::size_t>(j)]) >= distance) return;
        std::size_t other = 0;
        while (all.bodies[other].end <= j) ++other;
        throw SetupError(fmt::format(
            "the solids {} and {} touch or overlap at the start, at x = {:.6g} m, y = {:.6g} m: their particles must "
            "be "
            "{:g} m apart, for nothing keeps solids from passing through each other; move one of them (solid.origin)",
            other + 1, b + 1, here.x, here.y, distance));
      });
    }
}

double height_above_solids(const std::vector<InitialSolid>& solids, const Drop& drop, double centre_x, double gap,
                           double radius) {
  const Box box = drop.bounds();
  const double lowest = box.low.y, left = centre_x + box.low.x, right = centre_x + box.high.x;
  if (solids.size() == 1 && solids.front().outline.empty()) return solids.front().top + gap + radius - lowest;
  const double clearance = gap + radius;
  std::vector<Obstruction> obstructions;
  obstructions.reserve(solids.size());
  for (const InitialSolid& one : solids) obstructions.emplace_back(one, clearance);
  double top = -infinity;
  for (const Obstruction& one : obstructions) top = std::max(top, one.highest_between(left, right));
  if (!(top > -infinity))
    throw SetupError(fmt::format(
        "there is no solid below the drop, between x = {:.6g} m and {:.6g} m: move it (drop.centre_x), or give "
        "drop.placement = \"centre\" and drop.centre_y",
        left, right));
  const auto is_free = [&](double y) {
    return std::all_of(obstructions.begin(), obstructions.end(), [&](const Obstruction& one) {
      const Box about_centre = one.box().moved_by({-centre_x, -y});
      return drop.all_about(about_centre, [&](Vector p) { return one.is_free({centre_x + p.x, y + p.y}); });
    });
  };
  // On a slope the highest place below a drop is not the one it meets.
  double high = top + clearance - lowest, low = high - (right - left);
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (low + high);
    (is_free(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace sphdrop
