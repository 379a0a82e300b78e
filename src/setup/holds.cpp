#include "setup/holds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

/// Of equally near ones the first, so that a point support stays one particle and lets the body turn.
std::int32_t nearest_particle(const InitialSolid& body, const Point& place, double spacing, const char* key) {
  std::size_t nearest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < body.positions.size(); ++k) {
    const double squared = squared_length(body.positions[k] - Vector{place.x, place.y});
    // Rounding must not choose between equally near ones.
    if (!(squared < smallest - 1e-9 * spacing * spacing)) continue;
    smallest = squared;
    nearest = k;
  }
  if (!(smallest <= spacing * spacing * (1.0 + 1e-6)))
    throw SetupError(
        fmt::format("{} names the place ({:g}, {:g}) m, which is farther than a spacing of {:g} m from all "
                    "particles of the solid",
                    key, place.x, place.y, spacing));
  return static_cast<std::int32_t>(nearest);
}

void add(const Points& places, bool in_x, bool in_y, const char* key, double spacing, InitialSolid& body) {
  for (const Point& place : places) {
    const std::int32_t k = nearest_particle(body, place, spacing, key);
    const auto found =
        std::find_if(body.holds.begin(), body.holds.end(), [&](const Hold& h) { return h.particle == k; });
    Hold& hold = found != body.holds.end() ? *found : body.holds.emplace_back(Hold{k});
    hold.in_x = hold.in_x || in_x;
    hold.in_y = hold.in_y || in_y;
    Vector& velocity = body.velocities[static_cast<std::size_t>(k)];
    velocity = {in_x ? 0.0 : velocity.x, in_y ? 0.0 : velocity.y};
  }
}

std::int32_t farthest_from_held(const InitialSolid& body) {
  std::vector<Vector> held;
  for (std::size_t k = 0; k < body.positions.size(); ++k)
    if (body.is_fixed[k] != 0) held.push_back(body.positions[k]);
  for (const Hold& hold : body.holds) held.push_back(body.positions[static_cast<std::size_t>(hold.particle)]);
  auto farthest = static_cast<std::int32_t>(body.positions.size()) - 1;
  double largest = 0.0;
  for (std::size_t k = 0; k < body.positions.size() && !held.empty(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector& place : held) {
      nearest = std::min(nearest, squared_length(body.positions[k] - place));
      if (nearest <= largest) break;
    }
    if (!(nearest > largest)) continue;
    largest = nearest;
    farthest = static_cast<std::int32_t>(k);
  }
  return farthest;
}

}  // namespace

void add_holds(const Case::Solid& solid, double spacing, InitialSolid& body) {
  add(solid.pinned, true, true, "solid.pinned", spacing, body);
  add(solid.held_in_x, true, false, "solid.held_in_x", spacing, body);
  add(solid.held_in_y, false, true, "solid.held_in_y", spacing, body);
}

void choose_probe(const Case::Solid& solid, double spacing, InitialSolid& body) {
  if (!solid.probe.empty()) {
    body.deflection_probe.clear();
    for (const Point& place : solid.probe)
      body.deflection_probe.push_back(nearest_particle(body, place, spacing, "solid.probe"));
    std::sort(body.deflection_probe.begin(), body.deflection_probe.end());
    body.deflection_probe.erase(std::unique(body.deflection_probe.begin(), body.deflection_probe.end()),
                                body.deflection_probe.end());
  } else if (body.deflection_probe.empty() && body.mobile_count > 0) {
    body.deflection_probe = {farthest_from_held(body)};
  }
  if (body.middle_probe.empty()) body.middle_probe = body.deflection_probe;
}

}  // namespace sphdrop
