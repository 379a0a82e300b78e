#include "setup/lattice_filling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "setup/polygon_geometry.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

// Less of a quadrant is rounding.
constexpr double smallest_area = 1e-9;
constexpr double quadrant_area = 0.25;
// Lighter particles would need a shorter time step; heavier ones leave more of the body beyond the outermost particles,
// where strains are extrapolated.
constexpr double least_area = 0.25;
constexpr std::int64_t farthest_sliver = 4;

/// One quadrant, of side 1/2, that is wholly within the polygon, about its particle.
constexpr PlaneMoments whole_quadrant(double to_east, double to_north) {
  constexpr double x = 0.25, own = quadrant_area * (x * x + 1.0 / 48.0);
  return {quadrant_area, quadrant_area * x * to_east, quadrant_area * x * to_north, own, own};
}

struct Square {
  std::int64_t column, row;
  std::array<PlaneMoments, 4> quadrants;

  double area() const { return (quadrants[0].area + quadrants[1].area) + (quadrants[2].area + quadrants[3].area); }
};

std::vector<Square> squares_within(std::span<const Vector> polygon) {
  Vector low = polygon[0], high = polygon[0];
  for (const Vector& p : polygon) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::vector<Square> squares;
  std::array<std::vector<Vector>, 2> strips;
  std::vector<Vector> part;
  for (auto column = static_cast<std::int64_t>(std::floor(low.x)); static_cast<double>(column) < high.x; ++column) {
    const auto x = static_cast<double>(column);
    clip_in_x(polygon, x, x + 0.5, strips[0]);
    clip_in_x(polygon, x + 0.5, x + 1.0, strips[1]);
    double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
    for (const auto& strip : strips)
      for (const Vector& p : strip) {
        bottom = std::min(bottom, p.y);
        top = std::max(top, p.y);
      }
    if (!(bottom < top)) continue;
    for (auto row = static_cast<std::int64_t>(std::floor(bottom)); static_cast<double>(row) < top; ++row) {
      const auto y = static_cast<double>(row);
      Square square{column, row, {}};
      for (std::size_t quadrant = 0; quadrant < 4; ++quadrant) {
        const bool east = quadrant % 2 == 1, north = quadrant / 2 == 1;
        clip_in_y(strips[east ? 1 : 0], north ? y + 0.5 : y, north ? y + 1.0 : y + 0.5, part);
        PlaneMoments m = moments_of(part, {x + 0.5, y + 0.5});
        // A whole square is the same wherever it lies, to the last bit.
        if (m.area > quadrant_area - smallest_area) m = whole_quadrant(east ? 1.0 : -1.0, north ? 1.0 : -1.0);
        if (m.area > smallest_area) square.quadrants[quadrant] = m;
      }
      if (square.area() > 0.0) squares.push_back(square);
    }
  }
  return squares;
}

std::string place_text(Vector place, double spacing) {
  return fmt::format("x = {:.6g} m, y = {:.6g} m", place.x * spacing, place.y * spacing);
}

[[noreturn]] void refuse_as_too_thin(Vector place, double spacing, const char* what) {
  throw SetupError(fmt::format(
      "solid.polygon is too thin for a spacing of {:g} m about {}: {}; at least 2 particles must stand side by side "
      "everywhere, 4 or more bend well: take a smaller resolution.spacing, or a thicker or blunter outline",
      spacing, place_text(place, spacing), what));
}

// Blocks of 2 x 2 particles that share a side hold together; one that shares no more than a corner is a hinge.
void refuse_pieces(const LatticeFilling& filling, double spacing) {
  const std::size_t count = filling.column.size();
  const auto is_block = [&](std::int64_t column, std::int64_t row) {
    return filling.at(column, row) >= 0 && filling.at(column + 1, row) >= 0 && filling.at(column, row + 1) >= 0 &&
           filling.at(column + 1, row + 1) >= 0;
  };
  std::vector<char> is_reached(count, 0);
  std::vector<std::int32_t> waiting;
  bool is_first = true;
  for (std::size_t k = 0; k < count; ++k) {
    if (is_reached[k] != 0 || !is_block(filling.column[k], filling.row[k])) continue;
    if (!is_first)
      refuse_as_too_thin(filling.position(k), spacing, "the part there does not hold together with the rest");
    is_first = false;
    is_reached[k] = 1;
    waiting.assign(1, static_cast<std::int32_t>(k));
    while (!waiting.empty()) {
      const auto here = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      constexpr std::array<std::array<std::int64_t, 2>, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
      for (const auto& [east, north] : sides) {
        const std::int64_t column = filling.column[here] + east, row = filling.row[here] + north;
        if (!is_block(column, row)) continue;
        const std::int32_t next = filling.at(column, row);
        if (is_reached[static_cast<std::size_t>(next)] != 0) continue;
        is_reached[static_cast<std::size_t>(next)] = 1;
        waiting.push_back(next);
      }
    }
  }
}

// Of equally near ones the first.
std::int32_t nearest_particle(const LatticeFilling& filling, const Square& square, Vector place) {
  std::int32_t nearest = -1;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::int64_t column = square.column - farthest_sliver; column <= square.column + farthest_sliver; ++column)
    for (std::int64_t row = square.row - farthest_sliver; row <= square.row + farthest_sliver; ++row) {
      const std::int32_t k = filling.at(column, row);
      if (k < 0) continue;
      const double squared = squared_length(filling.position(static_cast<std::size_t>(k)) - place);
      if (squared < smallest) {
        smallest = squared;
        nearest = k;
      }
    }
  return nearest;
}

}  // namespace

double LatticeFilling::area(std::size_t k) const {
  return (quadrants[k][0].area + quadrants[k][1].area) + (quadrants[k][2].area + quadrants[k][3].area);
}

std::int32_t LatticeFilling::at(std::int64_t wanted_column, std::int64_t wanted_row) const {
  const auto [first, last] = std::equal_range(column.begin(), column.end(), wanted_column);
  const auto begin = row.begin() + (first - column.begin()), end = row.begin() + (last - column.begin());
  const auto found = std::lower_bound(begin, end, wanted_row);
  return found != end && *found == wanted_row ? static_cast<std::int32_t>(found - row.begin()) : -1;
}

LatticeFilling fill_with_lattice(std::span<const Vector> polygon, double spacing) {
  const std::vector<Square> squares = squares_within(polygon);
  LatticeFilling halves;
  for (const Square& square : squares) {
    if (square.area() < least_area - smallest_area) continue;
    halves.column.push_back(square.column);
    halves.row.push_back(square.row);
  }
  const auto is_in_block = [&](const Square& square) {
    const auto is_block = [&](std::int64_t column, std::int64_t row) {
      return halves.at(column, row) >= 0 && halves.at(column + 1, row) >= 0 && halves.at(column, row + 1) >= 0 &&
             halves.at(column + 1, row + 1) >= 0;
    };
    return is_block(square.column, square.row) || is_block(square.column - 1, square.row) ||
           is_block(square.column, square.row - 1) || is_block(square.column - 1, square.row - 1);
  };
  LatticeFilling filling;
  std::vector<const Square*> slivers;
  for (const Square& square : squares) {
    if (square.area() < least_area - smallest_area || !is_in_block(square)) {
      slivers.push_back(&square);
      continue;
    }
    filling.column.push_back(square.column);
    filling.row.push_back(square.row);
    filling.quadrants.push_back(square.quadrants);
  }
  if (filling.column.empty()) refuse_as_too_thin(polygon[0], spacing, "no 2 x 2 particles fit into it");
  refuse_pieces(filling, spacing);
  for (const Square* sliver : slivers) {
    const Vector middle{static_cast<double>(sliver->column) + 0.5, static_cast<double>(sliver->row) + 0.5};
    PlaneMoments all;
    for (const PlaneMoments& quadrant : sliver->quadrants) all += quadrant;
    const Vector centroid = middle + Vector{all.first_x, all.first_y} / all.area;
    const std::int32_t k = nearest_particle(filling, *sliver, centroid);
    if (k < 0) refuse_as_too_thin(centroid, spacing, "no particle stands within 4 spacings");
    const Vector from_particle = centroid - filling.position(static_cast<std::size_t>(k));
    const std::size_t direction = (from_particle.x >= 0.0 ? 1U : 0U) + (from_particle.y >= 0.0 ? 2U : 0U);
    const Vector shift = filling.position(static_cast<std::size_t>(k)) - middle;
    filling.quadrants[static_cast<std::size_t>(k)][direction] += moments_about(all, shift.x, shift.y);
  }
  return filling;
}

}  // namespace sphdrop
