#include "surface_tension/near_particles.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "particles/pack.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {

namespace {

constexpr auto lanes = static_cast<std::size_t>(pack_size);

}  // namespace

[[gnu::flatten]] std::vector<std::int32_t> particles_near(std::span<const Vector> points, std::span<const double> x,
                                                          std::span<const double> y, double reach) {
  assert(x.size() == y.size() && reach > 0.0);
  std::vector<double> point_x, point_y;
  for (const Vector point : points) {
    point_x.push_back(point.x);
    point_y.push_back(point.y);
  }
  const CellGrid grid(point_x, point_y, reach);
  // A little more, so that no rounding of a rectangle's edge leaves out one that counts.
  const double margin = reach * (1.0 + 1e-9);
  std::vector<std::int32_t> near;
  for (std::size_t first = 0; first < x.size(); first += lanes) {
    // The last vector is filled up with its first particle.
    const std::size_t count = std::min(lanes, x.size() - first);
    const auto place = [&](auto lane) {
      const auto k = static_cast<std::size_t>(lane);
      return k < count ? first + k : first;
    };
    const Pack here_x = count == lanes ? load(&x[first]) : Pack([&](auto lane) { return x[place(lane)]; });
    const Pack here_y = count == lanes ? load(&y[first]) : Pack([&](auto lane) { return y[place(lane)]; });
    Pack least(std::numeric_limits<double>::infinity());
    grid.for_each_run({hmin(here_x) - margin, hmin(here_y) - margin}, {hmax(here_x) + margin, hmax(here_y) + margin},
                      [&](CellGrid::Run run) {
                        for (std::size_t k = run.first; k < run.last; ++k) {
                          const auto point = static_cast<std::size_t>(grid.points()[k]);
                          const Pack to_x = Pack(point_x[point]) - here_x, to_y = Pack(point_y[point]) - here_y;
                          least = min(least, to_x * to_x + to_y * to_y);
                        }
                      });
    if (hmin(least) > reach * reach) continue;
    for (std::size_t lane = 0; lane < count; ++lane)
      if (least[lane] <= reach * reach) near.push_back(static_cast<std::int32_t>(first + lane));
  }
  return near;
}

}  // namespace sphdrop
