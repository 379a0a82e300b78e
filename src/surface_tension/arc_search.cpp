#include "surface_tension/arc_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "particles/pack.hpp"
#include "surface_tension/near_directions.hpp"

namespace sphdrop {

namespace {

constexpr auto lanes = static_cast<std::size_t>(pack_size);
constexpr double far_away = 1e150;  // its square is still finite

/// In units of R: circles that come so near to a gap are looked at as if they reached into it. Far more than the
/// directions' tolerance, whatever a circle's distance.
constexpr double nearness = 1e-7;

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
  finder_.start();
  if (!add_near(grid, place)) return;
  gaps_.clear();
  finder_.append_arcs(ids_[place], gaps_);
  if (gaps_.empty()) return;
  const bool are_narrow = std::all_of(gaps_.begin(), gaps_.end(), is_narrow);
  const std::size_t near = finder_.added_count();
  if (are_narrow)
    for (const Arc& gap : gaps_) add_those_in(gap, grid, place);
  else
    add_all(grid, place);
  if (are_narrow && finder_.added_count() == near)
    arcs.insert(arcs.end(), gaps_.begin(), gaps_.end());
  else
    finder_.append_arcs(ids_[place], arcs);
}

[[gnu::always_inline]] inline bool ArcSearch::add_near(const CellGrid& grid, std::size_t place) {
  const Vector here{x_[place], y_[place]}, corner{near_reach_, near_reach_};
  bool lower_is_here = false;
  grid.for_each_run(here - corner, here + corner, [&](CellGrid::Run run) {
    for (std::size_t k = run.first; k < run.last; ++k) {
      const Vector separation = Vector{x_[k], y_[k]} - here;
      const double squared = squared_length(separation);
      finder_.add_if(squared > 0.0 && squared < squared_near_reach_, separation, squared, ids_[k]);
      lower_is_here |= squared == 0.0 && ids_[k] < ids_[place];
    }
  });
  return !lower_is_here;
}

[[gnu::always_inline]] inline void ArcSearch::add_those_in(const Arc& gap, const CellGrid& grid, std::size_t place) {
  // A neighbour covers a direction if it is within R of the point of the circle there. Those that do, of directions in
  // the gap, are within R of an arc, which bulges by its sagitta out of the rectangle between its ends.
  const Vector here{x_[place], y_[place]};
  const Vector start = here + radius_ * gap.start, end = here + radius_ * gap.end;
  const double bulge = radius_ * (1.0 - 0.5 * length(gap.start + gap.end));
  const double margin = nearness * radius_;
  const double around = radius_ + bulge + 2.0 * margin;
  const Vector low{std::min(start.x, end.x) - around, std::min(start.y, end.y) - around};
  const Vector high{std::max(start.x, end.x) + around, std::max(start.y, end.y) + around};
  const double inverse_diameter = 0.5 / radius_;
  grid.for_each_run(low, high, [&](CellGrid::Run run) {
    for (std::size_t k = run.first; k < run.last; ++k) {
      const Vector separation = Vector{x_[k], y_[k]} - here;
      const double squared = squared_length(separation);
      // It covers one of the gap's ends, or its middle is in the gap.
      const double depth = std::max(dot(gap.start, separation), dot(gap.end, separation)) - inverse_diameter * squared;
      const double ahead = std::min(cross(gap.start, separation), cross(separation, gap.end));
      const bool is_in = std::max(depth, ahead) >= -margin;
      finder_.add_if(is_in && squared >= squared_near_reach_ && squared < finder_.squared_reach(), separation, squared,
                     ids_[k]);
    }
  });
}

void ArcSearch::add_all(const CellGrid& grid, std::size_t place) {
  const Vector here{x_[place], y_[place]}, corner{reach_, reach_};
  grid.for_each_run(here - corner, here + corner, [&](CellGrid::Run run) {
    for (std::size_t k = run.first; k < run.last; ++k) {
      const Vector separation = Vector{x_[k], y_[k]} - here;
      const double squared = squared_length(separation);
      finder_.add_if(squared >= squared_near_reach_ && squared < finder_.squared_reach(), separation, squared, ids_[k]);
    }
  });
}

}  // namespace sphdrop
