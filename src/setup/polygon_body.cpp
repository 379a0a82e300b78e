#include "setup/polygon_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "setup/lattice_filling.hpp"
#include "setup/polygon_geometry.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

/// Vertices of the contact surface, in spacings, with the solid on the right.
std::vector<Vector> contact_line(const std::vector<Vector>& polygon, double spacing) {
  constexpr double inset = 0.5;
  std::vector<Vector> line = subdivided(inset_polygon(polygon, inset), 1.0);
  Vector thin = polygon[0];
  bool is_thin = line.empty();
  for (const Vector& place : line) {
    if (is_thin || distance_to_border(polygon, place) > inset * (1.0 - 1e-6)) continue;
    is_thin = true;
    thin = place;
  }
  if (is_thin)
    throw SetupError(fmt::format(
        "solid.polygon is thinner than a spacing of {:g} m about x = {:.6g} m, y = {:.6g} m; take a smaller "
        "resolution.spacing, or a thicker outline",
        spacing, thin.x * spacing, thin.y * spacing));
  std::reverse(line.begin(), line.end());
  return line;
}

std::vector<std::int32_t> closed_polyline(std::size_t vertices) {
  std::vector<std::int32_t> polyline;
  for (std::size_t k = 0; k < vertices; ++k) polyline.push_back(static_cast<std::int32_t>(k));
  polyline.push_back(0);
  return polyline;
}

/// Weights of the four particles of the block nearest to the place, at most half a spacing beyond them.
ContactVertex vertex_at(const LatticeFilling& filling, Vector place, double spacing) {
  constexpr std::int64_t window = 5;
  const Vector from_middle = place - Vector{0.5, 0.5};
  const auto column = static_cast<std::int64_t>(std::floor(from_middle.x));
  const auto row = static_cast<std::int64_t>(std::floor(from_middle.y));
  ContactVertex best;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::int64_t i = column - window; i <= column + window; ++i)
    for (std::int64_t j = row - window; j <= row + window; ++j) {
      const std::array<std::int32_t, 4> corners{filling.at(i, j), filling.at(i + 1, j), filling.at(i, j + 1),
                                                filling.at(i + 1, j + 1)};
      if (std::any_of(corners.begin(), corners.end(), [](std::int32_t k) { return k < 0; })) continue;
      const double x = from_middle.x - static_cast<double>(i), y = from_middle.y - static_cast<double>(j);
      const Vector beyond{x - std::clamp(x, 0.0, 1.0), y - std::clamp(y, 0.0, 1.0)};
      if (!(squared_length(beyond) < smallest)) continue;
      smallest = squared_length(beyond);
      const double a = std::clamp(x, -0.5, 1.5), b = std::clamp(y, -0.5, 1.5);
      best = {4, corners, {(1.0 - a) * (1.0 - b), a * (1.0 - b), (1.0 - a) * b, a * b}};
    }
  if (best.count == 0)
    throw SetupError(
        fmt::format("solid.polygon: no particles are near the outline at x = {:.6g} m, y = {:.6g} m; take a "
                    "smaller resolution.spacing, or a blunter outline",
                    place.x * spacing, place.y * spacing));
  // Particles of no weight only cost.
  ContactVertex vertex;
  for (std::size_t k = 0; k < 4; ++k) {
    if (best.weight[k] == 0.0) continue;
    vertex.particle[static_cast<std::size_t>(vertex.count)] = best.particle[k];
    vertex.weight[static_cast<std::size_t>(vertex.count)] = best.weight[k];
    ++vertex.count;
  }
  return vertex;
}

std::vector<Vector> clamp_region(const Points& region) {
  if (region.size() > 2) return counterclockwise_polygon(region, 1.0);
  return counterclockwise_polygon({region[0], {region[1].x, region[0].y}, region[1], {region[0].x, region[1].y}}, 1.0);
}

void hold_in_clamps(const Case::Solid& solid, double spacing, InitialSolid& body) {
  for (std::size_t c = 0; c < solid.clamps.size(); ++c) {
    const std::vector<Vector> region = clamp_region(solid.clamps[c]);
    bool holds_any = false;
    for (std::size_t k = 0; k < body.positions.size(); ++k) {
      if (!contains(region, body.positions[k])) continue;
      body.is_fixed[k] = 1;
      holds_any = true;
    }
    if (!holds_any)
      throw SetupError(fmt::format(
          "region {} of solid.clamps holds no particle of the polygon; it must contain at least the middle of one of "
          "the lattice's squares of {:g} m",
          c + 1, spacing));
  }
  body.mobile_count =
      static_cast<std::size_t>(std::count(body.is_fixed.begin(), body.is_fixed.end(), static_cast<char>(0)));
  if (body.mobile_count == 0) throw SetupError("solid.clamps holds the whole polygon: make the regions smaller");
}

}  // namespace

InitialSolid build_polygon_body(const Case::Solid& solid, double spacing) {
  const Vector rows = Vector{solid.lattice_x, solid.lattice_y} / length({solid.lattice_x, solid.lattice_y});
  const auto turned = [](Vector p, Vector by) { return Vector{by.x * p.x - by.y * p.y, by.y * p.x + by.x * p.y}; };
  const std::vector<Vector> outline = counterclockwise_polygon(solid.polygon, spacing);
  std::vector<Vector> polygon;  // in the lattice's frame
  polygon.reserve(outline.size());
  for (const Vector& corner : outline) polygon.push_back(turned(corner, {rows.x, -rows.y}));
  const LatticeFilling filling = fill_with_lattice(polygon, spacing);
  InitialSolid body;
  for (std::size_t k = 0; k < filling.column.size(); ++k) {
    body.positions.push_back(spacing * turned(filling.position(k), rows));
    body.velocities.push_back({});
    body.masses.push_back(solid.density * spacing * spacing * filling.area(k));
    body.is_fixed.push_back(0);
  }
  body.quadrants = filling.quadrants;
  hold_in_clamps(solid, spacing, body);
  for (const Vector& place : contact_line(polygon, spacing))
    body.contact_vertices.push_back(vertex_at(filling, place, spacing));
  body.contact_polylines = {closed_polyline(body.contact_vertices.size())};
  for (const Vector& corner : outline) body.outline.push_back(spacing * corner);
  return body;
}

InitialSolid build_obstacle(const Case::Solid& solid, double spacing) {
  const std::vector<Vector> polygon = counterclockwise_polygon(solid.polygon, spacing);
  InitialSolid obstacle;
  for (const Vector& place : contact_line(polygon, spacing)) {
    obstacle.positions.push_back(spacing * place);
    obstacle.velocities.push_back({});
    obstacle.masses.push_back(solid.density * spacing * spacing);
    obstacle.is_fixed.push_back(1);
  }
  obstacle.contact_polylines = {closed_polyline(obstacle.positions.size())};
  for (const Vector& corner : polygon) obstacle.outline.push_back(spacing * corner);
  return obstacle;
}

}  // namespace sphdrop
