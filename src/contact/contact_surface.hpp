#pragma once
// The solid's boundary: polylines through its outermost particles (Sec. 2.4).

#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// One straight piece of the boundary, from vertex `first` to vertex `second` (indices into the caller's vertex
/// arrays). Walking from first to second the solid lies on the right, so the outward normal is left_normal(second -
/// first).
///
/// A vertex is convex or concave by the two segments that meet in it, so a set of segments that is only a part of the
/// boundary must contain, with every segment that liquid may come within contact distance of, both its neighbours
/// (part_of_surface() sees to that). -1 then stands for a free end of the boundary, or for a cut out of the liquid's
/// reach, where the difference never matters.
struct Segment {
  std::int32_t first = -1, second = -1;
  std::int32_t previous_segment = -1, next_segment = -1;

  friend bool operator==(const Segment&, const Segment&) = default;
};

/// The segments of polylines given as vertex indices, in order. A polyline that ends at its first vertex is closed.
/// Polylines of fewer than two vertices have no segment.
std::vector<Segment> segments_of_polylines(std::span<const std::vector<std::int32_t>> polylines);

/// A part of a boundary, with vertices and segments numbered anew in their old order, so that whatever is decided by
/// the lowest number is decided alike in the part and in the whole.
struct SurfacePart {
  std::vector<Segment> segments;
  std::vector<std::int32_t> original_segments;  ///< [segments] index in the whole, ascending
  std::vector<std::int32_t> original_vertices;  ///< [vertices of the part] index in the whole, ascending
};

/// The segments marked in `is_wanted` (shape: [segments]) and one more on either side of each.
SurfacePart part_of_surface(std::span<const Segment> segments, std::span<const char> is_wanted);

/// Segments together with the present positions of their vertices (shapes: [vertices], m).
struct ContactSurface {
  std::span<const Segment> segments;
  std::span<const double> vertex_x, vertex_y;

  Vector vertex(std::int32_t index) const { return {vertex_x[index], vertex_y[index]}; }
};

}  // namespace sphdrop
