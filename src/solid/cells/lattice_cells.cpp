#include "solid/cells/lattice_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace sphdrop {

namespace {

struct Place {
  std::int64_t column, row;
  auto operator<=>(const Place&) const = default;
};

std::vector<Place> lattice_places(std::span<const Vector> positions, double spacing) {
  std::vector<Place> places;
  places.reserve(positions.size());
  if (positions.empty()) return places;
  const Vector origin = positions[0];
  for (const Vector& p : positions) {
    const double x = (p.x - origin.x) / spacing, y = (p.y - origin.y) / spacing;
    const double column = std::floor(x + 0.5), row = std::floor(y + 0.5);
    if (!(std::abs(x - column) < 1e-3 && std::abs(y - row) < 1e-3))
      throw std::invalid_argument("a solid of cells needs its particles on a square lattice");
    places.push_back({static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)});
    if (places.size() > 1 && !(places[places.size() - 2] < places.back()))
      throw std::invalid_argument("a solid of cells needs its particles column by column, from bottom to top");
  }
  return places;
}

// A cell and what it gets of its corners' quadrants follow from the column to the left of it, its own two and the next.
// Of alike columns all cells are the same but for those of the first and of the last two, and so are the neighbours.
constexpr std::int64_t columns_in_table = 4;

// With no more columns alike.
struct ShortBody {
  std::vector<Vector> places;
  std::vector<char> is_held;

  explicit ShortBody(std::span<const ColumnStretch> stretches) {
    std::int64_t x = 0;
    for (const ColumnStretch& stretch : stretches)
      for (std::int64_t column = 0; column < std::min(stretch.columns, columns_in_table); ++column, ++x)
        for (std::int64_t row = 0; row < stretch.rows(); ++row) {
          places.push_back({static_cast<double>(x), static_cast<double>(stretch.lowest_row + row)});
          is_held.push_back(stretch.is_held[static_cast<std::size_t>(row)]);
        }
  }
};

enum Corner : std::size_t { sw, se, nw, ne };
// The direction of each corner.
constexpr std::array<double, 4> to_east{-1, 1, -1, 1}, to_north{-1, -1, 1, 1};

// Sums over the quadrants of a cell: area and moments about the middle of its corners, in spacings. All terms are
// multiples of a power of 2, so that equal shapes have equal bits.
struct Body {
  double area = 0, first_x = 0, first_y = 0, second_x = 0, second_y = 0;

  void add_quadrant(double share, double x, double y) {
    constexpr double quadrant = 0.25, own_moment = 1.0 / 48.0;  // of a square of side 1/2
    area += share * quadrant;
    first_x += share * quadrant * x;
    first_y += share * quadrant * y;
    second_x += share * quadrant * (x * x + own_moment);
    second_y += share * quadrant * (y * y + own_moment);
  }
  /// `part` lies about a place at (x, y) from the middle.
  void add_part(double share, const PlaneMoments& part, double x, double y) {
    const PlaneMoments moved = moments_about(part, -x, -y);
    area += share * moved.area;
    first_x += share * moved.first_x;
    first_y += share * moved.first_y;
    second_x += share * moved.second_x;
    second_y += share * moved.second_y;
  }
};

}  // namespace

LatticeCells::LatticeCells(std::span<const Vector> positions, std::span<const char> is_held, double spacing,
                           bool held_at_edge, std::span<const std::array<PlaneMoments, 4>> quadrants)
    : particle_count_(static_cast<std::int64_t>(positions.size())) {
  const std::vector<Place> places = lattice_places(positions, spacing);
  const auto count = static_cast<std::int32_t>(places.size());
  const auto place = [&](std::int32_t k) { return places[static_cast<std::size_t>(k)]; };
  const auto held = [&](std::int32_t k) { return is_held[static_cast<std::size_t>(k)] != 0; };
  const auto is_north_of_next = [&](std::int32_t k) {
    return k >= 0 && k + 1 < count && place(k + 1) == Place{place(k).column, place(k).row + 1};
  };
  east_.assign(places.size(), -1);
  west_.assign(places.size(), -1);
  // The next column's particles are met in the same order as this one's.
  std::int32_t east = 0;
  for (std::int32_t k = 0; k < count; ++k) {
    const Place wanted{place(k).column + 1, place(k).row};
    while (east < count && place(east) < wanted) ++east;
    if (east == count || place(east) != wanted) continue;
    east_[static_cast<std::size_t>(k)] = east;
    west_[static_cast<std::size_t>(east)] = k;
  }

  const auto quadrant_area = [&](std::int32_t k, std::size_t direction) {
    return quadrants[static_cast<std::size_t>(k)][direction].area;
  };
  const auto is_cell = [&](std::int32_t k) {
    if (k < 0 || east_of(k) < 0 || !is_north_of_next(k) || !is_north_of_next(east_of(k))) return false;
    if (quadrants.empty()) return true;
    const double between = (quadrant_area(k, ne) + quadrant_area(east_of(k), nw)) +
                           (quadrant_area(k + 1, se) + quadrant_area(east_of(k) + 1, sw));
    return between >= 0.25;
  };
  // By their south-west corners: the four cells about a particle, -1 for none.
  const auto cells_about = [&](std::int32_t k) {
    const std::int32_t south = k > 0 && is_north_of_next(k - 1) ? k - 1 : -1;
    std::array<std::int32_t, 4> cells{south < 0 ? -1 : west_of(south), south, west_of(k), k};
    for (std::int32_t& cell : cells)
      if (!is_cell(cell)) cell = -1;
    return cells;
  };

  std::vector<Body> bodies(places.size());
  for (std::int32_t k = 0; k < count; ++k) {
    const std::array<std::int32_t, 4> cells = cells_about(k);
    if (cells == std::array<std::int32_t, 4>{-1, -1, -1, -1}) {
      if (held(k)) continue;
      throw std::invalid_argument("a solid of cells must be two particles thick everywhere: particle " +
                                  std::to_string(k) + " belongs to no 2 x 2 block");
    }
    if (held_at_edge && held(k)) continue;
    // A quadrant's middle from the middle of the cell in direction `of`, of which this particle is the opposite corner.
    const auto give = [&](std::size_t quadrant, std::size_t of, double share) {
      if (cells[of] < 0) return;
      if (!quadrants.empty()) {
        bodies[static_cast<std::size_t>(cells[of])].add_part(share, quadrants[static_cast<std::size_t>(k)][quadrant],
                                                             -0.5 * to_east[of], -0.5 * to_north[of]);
        return;
      }
      bodies[static_cast<std::size_t>(cells[of])].add_quadrant(share, 0.25 * to_east[quadrant] - 0.5 * to_east[of],
                                                               0.25 * to_north[quadrant] - 0.5 * to_north[of]);
    };
    for (const std::size_t quadrant : {sw, se, nw, ne}) {
      if (cells[quadrant] >= 0) {
        give(quadrant, quadrant, 1.0);
        continue;
      }
      // The corners' numbers are two bits, east and north.
      const std::size_t beside = quadrant ^ 1U, above_or_below = quadrant ^ 2U, opposite = quadrant ^ 3U;
      const int found = (cells[beside] >= 0 ? 1 : 0) + (cells[above_or_below] >= 0 ? 1 : 0);
      if (found == 0) {
        give(quadrant, opposite, 1.0);
      } else {
        give(quadrant, beside, 1.0 / found);
        give(quadrant, above_or_below, 1.0 / found);
      }
    }
  }

  shape_index_.assign(places.size(), -1);
  std::map<std::array<double, 7>, std::int32_t> known;
  for (std::int32_t k = 0; k < count; ++k) {
    if (!is_cell(k)) continue;
    const bool held_sw = held(k), held_nw = held(k + 1), held_se = held(east_of(k)), held_ne = held(east_of(k) + 1);
    if (held_sw && held_nw && held_se && held_ne) continue;
    // Where one side is held and the other free, the edge lies midway, and so does the middle of what is left.
    const auto direction = [&](bool a_low, bool b_low, bool a_high, bool b_high) {
      if (!held_at_edge) return 0;
      if (a_low && b_low && !a_high && !b_high) return 1;
      return !a_low && !b_low && a_high && b_high ? -1 : 0;
    };
    const int free_x = direction(held_sw, held_nw, held_se, held_ne);
    const int free_y = direction(held_sw, held_se, held_nw, held_ne);
    const Body& body = bodies[static_cast<std::size_t>(k)];
    if (!quadrants.empty() && body.area < 1e-9) continue;  // the held corners have it all
    const double x = body.first_x / body.area, y = body.first_y / body.area;
    const std::array<double, 7> numbers{body.area,
                                        x - 0.25 * free_x,
                                        y - 0.25 * free_y,
                                        body.second_x - body.area * x * x,
                                        body.second_y - body.area * y * y,
                                        free_x != 0 ? 2.0 : 1.0,
                                        free_y != 0 ? 2.0 : 1.0};
    const auto [found, is_new] = known.emplace(numbers, static_cast<std::int32_t>(shapes_.size()));
    if (is_new) shapes_.push_back({numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6]});
    shape_index_[static_cast<std::size_t>(k)] = found->second;
    ++cell_count_;
  }
}

LatticeCells::LatticeCells(std::span<const ColumnStretch> columns, bool held_at_edge) {
  const ShortBody body(columns);
  *this = LatticeCells(body.places, body.is_held, 1.0, held_at_edge);
  std::int32_t begin_in_table = 0;
  particle_count_ = 0;
  for (const ColumnStretch& stretch : columns) {
    const std::int64_t in_table = std::min(stretch.columns, columns_in_table), omitted = stretch.columns - in_table;
    const auto rows = static_cast<std::int32_t>(stretch.rows());
    for (std::int32_t k = begin_in_table + rows; omitted > 0 && k < begin_in_table + 2 * rows; ++k)
      if (shape_index_[static_cast<std::size_t>(k)] >= 0) cell_count_ += omitted;
    stretches_.push_back({static_cast<std::int32_t>(particle_count_),
                          static_cast<std::int32_t>(particle_count_ + stretch.particles()), begin_in_table, rows,
                          static_cast<std::int32_t>(omitted * rows)});
    particle_count_ += stretch.particles();
    begin_in_table += static_cast<std::int32_t>(in_table) * rows;
  }
}

}  // namespace sphdrop
