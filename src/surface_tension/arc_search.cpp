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

}  // namespace

ArcSearch::ArcSearch(double radius)
    : radius_(radius),
      // A little more, so that no rounding of a rectangle's edge leaves out one that counts.
      near_reach_(std::sqrt(NearDirections<double>::squared_reach(radius)) * (1.0 + 1e-9)),
      reach_(2.0 * radius * (1.0 + 1e-9)),
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
      const Pack cover = directions.cover();
      for (std::size_t lane = 0; lane < count; ++lane)
        if (!(cover[lane] > 0.0) && is_searched_[first + lane] != 0) open_.push_back(first + lane);
    }
  }
}

[[gnu::flatten]] void ArcSearch::find_arcs_of(const CellGrid& grid, std::size_t place, std::vector<Arc>& arcs) {
  const Vector here{x_[place], y_[place]};
  const double squared_reach = finder_.squared_reach();
  bool lower_is_here = false;
  finder_.start();
  grid.for_each_run({here.x - reach_, here.y - reach_}, {here.x + reach_, here.y + reach_}, [&](CellGrid::Run run) {
    const std::size_t count = run.last - run.first;
    if (squared_distances_.size() < count + lanes) {
      squared_distances_.resize(count + lanes);
      candidates_.resize(count + lanes);
    }
    for (std::size_t k = 0; k < count; k += lanes) {
      const Pack x = load(&x_[run.first + k]) - Pack(here.x), y = load(&y_[run.first + k]) - Pack(here.y);
      store(x * x + y * y, &squared_distances_[k]);
    }
    // Without branches: whether the next one is near enough cannot be foretold.
    std::size_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
      candidates_[found] = k;
      found += squared_distances_[k] < squared_reach ? 1 : 0;
    }
    for (std::size_t c = 0; c < found; ++c) {
      const std::size_t k = candidates_[c], neighbour = run.first + k;
      if (squared_distances_[k] > 0.0)
        finder_.add(Vector{x_[neighbour], y_[neighbour]} - here, squared_distances_[k], ids_[neighbour]);
      else
        lower_is_here = lower_is_here || ids_[neighbour] < ids_[place];
    }
  });
  if (!lower_is_here) finder_.append_arcs(ids_[place], arcs);
}

}  // namespace sphdrop
