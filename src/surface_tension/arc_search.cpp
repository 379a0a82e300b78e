#include "surface_tension/arc_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "particles/pack.hpp"
#include "surface_tension/near_directions.hpp"

namespace sphdrop {

namespace {

constexpr auto lanes = static_cast<std::size_t>(pack_size);
constexpr double far_away = 1e150;  // its square is still finite

/// In units of R: circles that come so near to a gap are looked at as if they reached into it. Far more than the
/// directions' tolerance, whatever a circle's distance.
constexpr double nearness = 1e-7;

/// Coincident particles are no neighbours.
constexpr double least_squared_distance = std::numeric_limits<double>::denorm_min();

/// Up to a third of a turn. That of a lonely particle, whose ends are the same, is not.
bool is_narrow(const Arc& gap) {
  return cross(gap.start, gap.end) > 0.0 && dot(gap.start, gap.end) > -0.5;
}

}  // namespace

ArcSearch::ArcSearch(double radius)
    : radius_(radius),
      // A little more, so that no rounding of a rectangle's edge leaves out one that counts.
      near_reach_(std::sqrt(NearDirections<double>::squared_reach(radius)) * (1.0 + 1e-9)),
      reach_(2.0 * radius * (1.0 + 1e-9)),
      squared_near_reach_(NearDirections<double>::squared_reach(radius)),
      finder_(radius) {}

void ArcSearch::find(std::span<const double> x, std::span<const double> y, std::span<const std::int64_t> ids,
                     std::size_t searched, std::vector<Arc>& arcs, std::vector<Vector>& centres) {
  assert(x.size() == y.size() && ids.size() == x.size() && searched <= x.size());
  const CellGrid grid(x, y, near_reach_);
  sort_by_cell(grid, x, y, ids, searched);
  find_open(grid);
  for (const std::size_t place : open_) {
    find_arcs_of(grid, place, arcs);
    centres.resize(arcs.size(), {x_[place], y_[place]});
  }
}

void ArcSearch::sort_by_cell(const CellGrid& grid, std::span<const double> x, std::span<const double> y,
                             std::span<const std::int64_t> ids, std::size_t searched) {
  const std::span<const std::int32_t> points = grid.points();
  x_.resize(points.size() + lanes, far_away);
  y_.resize(points.size() + lanes, far_away);
  ids_.resize(points.size());
  is_searched_.resize(points.size());
  for (std::size_t place = 0; place < points.size(); ++place) {
    const auto k = static_cast<std::size_t>(points[place]);
    x_[place] = x[k];
    y_[place] = y[k];
    ids_[place] = ids[k];
    is_searched_[place] = k < searched ? 1 : 0;
  }
  std::fill(x_.end() - lanes, x_.end(), far_away);
  std::fill(y_.end() - lanes, y_.end(), far_away);
}

// Particles that follow one another along a row of cells have nearly the same neighbours: they are looked at together,
// one in each lane.
[[gnu::flatten]] void ArcSearch::find_open(const CellGrid& grid) {
  open_.clear();
  for (std::size_t r = 0; r < grid.row_count(); ++r) {
    const CellGrid::Run row = grid.row(r);
    for (std::size_t first = row.first; first < row.last; first += lanes) {
      const std::size_t count = std::min(lanes, row.last - first);
      const auto [low_x, high_x] = std::minmax_element(&x_[first], &x_[first] + count);
      const auto [low_y, high_y] = std::minmax_element(&y_[first], &y_[first] + count);
      const Pack x = load(&x_[first]), y = load(&y_[first]);
      NearDirections<Pack> directions(radius_);
      grid.for_each_run({*low_x - near_reach_, *low_y - near_reach_}, {*high_x + near_reach_, *high_y + near_reach_},
                        [&](CellGrid::Run run) {
                          for (std::size_t k = run.first; k < run.last; ++k)
                            directions.add(Pack(x_[k]) - x, Pack(y_[k]) - y);
                        });
      for (std::size_t lane = 0; lane < count; ++lane)
        if (!directions.cover(lane) && is_searched_[first + lane] != 0) open_.push_back(first + lane);
    }
  }
}

// What near neighbours leave uncovered is mostly the arc already: where they cover the circle, others change nothing,
// and of these few come near the gap. So the walk round the circle is over the near ones, and once more if any others
// cover a part of a gap, or come so near to it that rounding could matter. The arcs are those of a walk over all of
// them.
[[gnu::flatten]] void ArcSearch::find_arcs_of(const CellGrid& grid, std::size_t place, std::vector<Arc>& arcs) {
  const Vector here{x_[place], y_[place]};
  finder_.start();
  add_between(least_squared_distance, squared_near_reach_, near_reach_, grid, here);
  gaps_.clear();
  finder_.append_arcs(ids_[place], gaps_);
  if (gaps_.empty() || lower_is_here(grid, place)) return;
  const bool are_narrow = std::all_of(gaps_.begin(), gaps_.end(), is_narrow);
  const std::size_t near = finder_.added_count();
  if (are_narrow)
    for (const Arc& gap : gaps_) add_those_in(gap, grid, here);
  else
    add_between(squared_near_reach_, finder_.squared_reach(), reach_, grid, here);
  if (are_narrow && finder_.added_count() == near)
    arcs.insert(arcs.end(), gaps_.begin(), gaps_.end());
  else
    finder_.append_arcs(ids_[place], arcs);
}

[[gnu::always_inline]] inline void ArcSearch::add_between(double low, double high, double reach, const CellGrid& grid,
                                                          Vector here) {
  const Vector corner{reach, reach};
  grid.for_each_run(here - corner, here + corner, [&](CellGrid::Run run) {
    const std::size_t count = run.last - run.first;
    finder_.add_between(low, high, here, {&x_[run.first], count}, {&y_[run.first], count}, {&ids_[run.first], count});
  });
}

[[gnu::always_inline]] inline void ArcSearch::add_those_in(const Arc& gap, const CellGrid& grid, Vector here) {
  // A neighbour covers a direction if it is within R of the point of the circle there. Those that do, of directions in
  // the gap, are within R of an arc, which bulges by its sagitta out of the rectangle between its ends.
  const Vector start = here + radius_ * gap.start, end = here + radius_ * gap.end;
  const double bulge = radius_ * (1.0 - 0.5 * length(gap.start + gap.end));
  const double margin = nearness * radius_;
  const double around = radius_ + bulge + 2.0 * margin;
  const Vector low{std::min(start.x, end.x) - around, std::min(start.y, end.y) - around};
  const Vector high{std::max(start.x, end.x) + around, std::max(start.y, end.y) + around};
  const Pack inverse_diameter = 0.5 / radius_, squared_reach = finder_.squared_reach();
  const auto along = [](Vector direction, const Pack& x, const Pack& y) { return direction.x * x + direction.y * y; };
  const auto left_of = [](Vector direction, const Pack& x, const Pack& y) { return direction.x * y - direction.y * x; };
  grid.for_each_run(low, high, [&](CellGrid::Run run) {
    for (std::size_t first = run.first; first < run.last; first += lanes) {
      const Pack x = load(&x_[first]) - here.x, y = load(&y_[first]) - here.y;
      const Pack squared = x * x + y * y;
      // It covers one of the gap's ends, or its middle is in the gap; and only signs matter of what it is apart.
      const Pack depth = max(along(gap.start, x, y), along(gap.end, x, y)) - inverse_diameter * squared;
      const Pack ahead = min(left_of(gap.start, x, y), -left_of(gap.end, x, y));
      const Pack apart = min(squared - squared_near_reach_, squared_reach - squared);
      const Pack counts = min(max(depth, ahead) + margin, apart);
      if (hmax(counts) < 0.0) continue;
      for (std::size_t lane = 0; lane < std::min(lanes, run.last - first); ++lane)
        if (counts[lane] >= 0.0 && squared[lane] < finder_.squared_reach())
          finder_.add({x[lane], y[lane]}, squared[lane], ids_[first + lane]);
    }
  });
}

// Of coincident particles only the lowest has arcs.
bool ArcSearch::lower_is_here(const CellGrid& grid, std::size_t place) const {
  bool found = false;
  grid.for_each_run({x_[place], y_[place]}, {x_[place], y_[place]}, [&](CellGrid::Run run) {
    for (std::size_t k = run.first; k < run.last; ++k)
      found |= squared_length(Vector{x_[k], y_[k]} - Vector{x_[place], y_[place]}) == 0.0 && ids_[k] < ids_[place];
  });
  return found;
}

}  // namespace sphdrop
