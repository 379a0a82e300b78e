#pragma once
// Which segments of the solid's boundary a point may be near to.

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "contact/contact_surface.hpp"

namespace sphdrop {

/// Candidates found by rebuild() stay valid while no point has come nearer to a segment by more than the reach less the
/// distance of interest.
class SegmentSearch {
 public:
  /// Finds for every point the segments within `reach` (m) of it. Shapes: [points], [vertices]; positions in m. Points
  /// that are not finite have none.
  void rebuild(std::span<const double> point_x, std::span<const double> point_y, const ContactSurface& surface,
               double reach);

  /// The points that have any candidate, ascending.
  std::span<const std::int32_t> active_points() const { return active_points_; }
  /// The segments within reach of the k-th active point, ascending.
  std::span<const std::int32_t> candidates(std::size_t k) const {
    return std::span(candidates_).subspan(candidate_starts_[k], candidate_starts_[k + 1] - candidate_starts_[k]);
  }

 private:
  struct CellEntry {
    std::int64_t column, row;
    std::int32_t segment;
    friend bool operator<(const CellEntry& a, const CellEntry& b) {
      return std::tie(a.column, a.row, a.segment) < std::tie(b.column, b.row, b.segment);
    }
  };

  // The segments that may be within reach of a cell, sorted by cell, then segment.
  std::vector<CellEntry> cell_entries_;
  std::vector<std::int32_t> active_points_;
  std::vector<std::int32_t> candidate_starts_{0};
  std::vector<std::int32_t> candidates_;
};

}  // namespace sphdrop
