#include "decomposition/neighbour_ranks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>

namespace sphdrop {
namespace {

/// Coordinates carry a rounding error each; one rank too many costs a few ghosts, one too few a wrong answer.
double rounding_margin(double u, double v, double reach) {
  return 8 * std::numeric_limits<double>::epsilon() * (std::abs(u) + std::abs(v) + reach + 1);
}

double square(double a) {
  return a * a;
}

double squared_distance(double u, double v, Cell cell) {
  const double du = std::max({cell.column - u, 0.0, u - (cell.column + 1.0)});
  const double dv = std::max({cell.row - v, 0.0, v - (cell.row + 1.0)});
  return square(du) + square(dv);
}

struct Offset {
  double columns, rows;  // whole numbers: squares would overflow 32 bits
};
Offset offset(Cell a, Cell b) {
  return {std::abs(static_cast<double>(a.column) - b.column), std::abs(static_cast<double>(a.row) - b.row)};
}
double least_squared_distance(Offset o) {
  return square(std::max(o.columns - 1, 0.0)) + square(std::max(o.rows - 1, 0.0));
}
double greatest_squared_distance(Offset o) {
  return square(o.columns + 1) + square(o.rows + 1);
}

}  // namespace

void NeighbourRanks::collect(const CellOwners& table, Cell centre, std::vector<ForeignCell>& foreign) const {
  foreign.clear();
  const double reach = reach_ + rounding_margin(centre.column, centre.row, reach_);
  const auto consider = [&](std::size_t number) {
    const Cell cell = table.index.cells()[number];
    if (table.owners[number] != own_rank_ && least_squared_distance(offset(centre, cell)) <= square(reach))
      foreign.push_back({cell, table.owners[number]});
  };
  const double radius = std::floor(reach) + 1;  // in cells, on either side
  if (square(2 * radius + 1) > static_cast<double>(table.index.size())) {
    for (std::size_t number = 0; number < table.index.size(); ++number) consider(number);
  } else {
    const auto r = static_cast<std::int32_t>(radius);
    for (std::int32_t column = centre.column - r; column <= centre.column + r; ++column)
      for (std::int32_t row = centre.row - r; row <= centre.row + r; ++row)
        if (const std::int32_t number = table.index.find({column, row}); number != CellIndex::absent)
          consider(static_cast<std::size_t>(number));
  }
  const auto nearness = [&](const ForeignCell& f) {
    return std::tuple(f.owner, greatest_squared_distance(offset(centre, f.cell)), f.cell);
  };
  std::sort(foreign.begin(), foreign.end(),
            [&](const ForeignCell& a, const ForeignCell& b) { return nearness(a) < nearness(b); });
  // A cell that is in reach wherever the point lies settles its owner: the rest need not be looked at.
  int settled = -1;
  std::erase_if(foreign, [&](const ForeignCell& f) {
    if (f.owner == settled) return true;
    if (greatest_squared_distance(offset(centre, f.cell)) <= square(reach_)) settled = f.owner;
    return false;
  });
}

void NeighbourRanks::append(const CellOwners& table, double u, double v, double reach, std::vector<int>& ranks) {
  assert(reach >= 0);
  if (reach != reach_) {
    reach_ = reach;
    forget();
  }
  const Cell cell = cell_at(u, v);
  const std::int32_t number = table.index.find(cell);
  const bool is_own = number != CellIndex::absent && table.owners[static_cast<std::size_t>(number)] == own_rank_;
  if (is_own && of_cell_.size() < table.index.size()) of_cell_.resize(table.index.size());
  Surroundings& near = is_own ? of_cell_[static_cast<std::size_t>(number)] : elsewhere_;
  if (!is_own || near.version != version_) {
    collect(table, cell, near.foreign);
    near.version = version_;
  }
  const double limit = square(reach + rounding_margin(u, v, reach));
  int last = -1;
  for (const ForeignCell& f : near.foreign) {
    if (f.owner == last || squared_distance(u, v, f.cell) > limit) continue;
    last = f.owner;
    ranks.push_back(f.owner);
  }
}

}  // namespace sphdrop
