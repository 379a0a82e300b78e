#include "contact/segment_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "contact/foot_point.hpp"

namespace sphdrop {
namespace {

/// Saturates far outside any domain, so that a particle thrown there does not overflow the index.
std::int64_t cell_index(double coordinate, double cell_size) {
  constexpr double limit = 1e15;
  return static_cast<std::int64_t>(std::clamp(std::floor(coordinate / cell_size), -limit, limit));
}

/// Wide enough that a segment reaches only a few cells, even where one is far longer than the reach.
double contact_cell_size(const ContactSurface& surface, double reach) {
  double longest_extent = 0.0;
  for (const Segment& s : surface.segments) {
    const Vector extent = surface.vertex(s.second) - surface.vertex(s.first);
    longest_extent = std::max({longest_extent, std::abs(extent.x), std::abs(extent.y)});
  }
  return std::max(2.0 * reach, longest_extent / 16.0);
}

}  // namespace

void SegmentSearch::rebuild(std::span<const double> point_x, std::span<const double> point_y,
                            const ContactSurface& surface, double reach) {
  assert(point_x.size() == point_y.size() && surface.vertex_x.size() == surface.vertex_y.size() && reach > 0.0);
  cell_entries_.clear();
  active_points_.clear();
  candidates_.clear();
  candidate_starts_.assign(1, 0);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector low{infinity, infinity}, high{-infinity, -infinity};  // of the points
  for (std::size_t i = 0; i < point_x.size(); ++i) {
    if (!std::isfinite(point_x[i] + point_y[i])) continue;
    low = {std::min(low.x, point_x[i]), std::min(low.y, point_y[i])};
    high = {std::max(high.x, point_x[i]), std::max(high.y, point_y[i])};
  }
  const double cell_size = contact_cell_size(surface, reach);
  for (std::size_t k = 0; k < surface.segments.size(); ++k) {
    const Vector a = surface.vertex(surface.segments[k].first);
    const Vector b = surface.vertex(surface.segments[k].second);
    if (!std::isfinite(a.x + a.y + b.x + b.y)) continue;
    // Most of a long boundary is far from every point.
    if (std::max(a.x, b.x) + reach < low.x || std::min(a.x, b.x) - reach > high.x ||
        std::max(a.y, b.y) + reach < low.y || std::min(a.y, b.y) - reach > high.y)
      continue;
    const auto last_column = cell_index(std::max(a.x, b.x) + reach, cell_size);
    const auto last_row = cell_index(std::max(a.y, b.y) + reach, cell_size);
    for (auto column = cell_index(std::min(a.x, b.x) - reach, cell_size); column <= last_column; ++column)
      for (auto row = cell_index(std::min(a.y, b.y) - reach, cell_size); row <= last_row; ++row)
        cell_entries_.push_back({column, row, static_cast<std::int32_t>(k)});
  }
  std::sort(cell_entries_.begin(), cell_entries_.end());

  for (std::size_t i = 0; i < point_x.size(); ++i) {
    const Vector x{point_x[i], point_y[i]};
    if (!std::isfinite(x.x + x.y)) continue;
    const CellEntry cell{cell_index(x.x, cell_size), cell_index(x.y, cell_size), -1};
    for (auto entry = std::lower_bound(cell_entries_.begin(), cell_entries_.end(), cell);
         entry != cell_entries_.end() && entry->column == cell.column && entry->row == cell.row; ++entry) {
      const Segment& s = surface.segments[entry->segment];
      const auto projection = project_on_segment(x, surface.vertex(s.first), surface.vertex(s.second));
      if (projection.squared_distance <= reach * reach) candidates_.push_back(entry->segment);
    }
    if (static_cast<std::size_t>(candidate_starts_.back()) == candidates_.size()) continue;
    active_points_.push_back(static_cast<std::int32_t>(i));
    candidate_starts_.push_back(static_cast<std::int32_t>(candidates_.size()));
  }
}

}  // namespace sphdrop
