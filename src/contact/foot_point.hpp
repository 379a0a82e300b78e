#pragma once
// The point of the solid's boundary nearest to a fluid particle (Sec. 2.4, Eq 25).

#include <cstdint>
#include <span>

#include "contact/contact_surface.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// Where a particle meets the boundary.
struct FootPoint {
  std::int32_t segment = -1;  ///< -1: there was none to look at
  double fraction = 0;        ///< of the way from the segment's first to its second vertex, in [0, 1]
  bool at_vertex = false;     ///< the nearest point is the vertex at fraction 0 or 1, which takes all of the reaction
  Vector normal;              ///< outward unit vector along the line from foot point to particle
  double distance = 0;        ///< d_p, m: along the normal, negative inside the solid
};

/// The nearest point of one segment.
struct SegmentProjection {
  double fraction = 0;
  double squared_distance = 0;  ///< m2
  bool at_vertex = false;       ///< the perpendicular's foot lies beyond this end of the segment
};

/// The point of the segment from `first` to `second` nearest to x.
inline SegmentProjection project_on_segment(Vector x, Vector first, Vector second) {
  const Vector direction = second - first;
  const Vector from_first = x - first;
  const double along = dot(from_first, direction);
  const double squared = squared_length(direction);
  // At an end the vertex itself is taken, so that the two segments that share it give the same bits and tie exactly.
  if (along < 0.0 || squared == 0.0) return {0.0, squared_length(from_first), true};
  if (along > squared) return {1.0, squared_length(x - second), true};
  const double fraction = along / squared;
  return {fraction, squared_length(from_first - fraction * direction), false};
}

/// +1 where a particle whose nearest boundary point is this vertex lies outside the solid, -1 inside it: outside a
/// convex vertex or a free end, inside a concave one. `before` and `after` are the directions of the segments that meet
/// in the vertex, `from_vertex` points to the particle. A segment's side would not do: beyond its end, the wrong side
/// is next door.
inline double side_of_vertex(Vector before, Vector after, Vector from_vertex) {
  const bool turns_sharply = dot(before, after) <= 0.0;
  if (turns_sharply) return cross(before, after) <= 0.0 ? 1.0 : -1.0;
  // On an almost straight boundary convex and concave differ by rounding; there the mean normal tells the side, and for
  // every other gentle turn it says the same as the turn.
  const Vector mean_normal = left_normal(before / length(before) + after / length(after));
  return dot(from_vertex, mean_normal) >= 0.0 ? 1.0 : -1.0;
}

/// The foot point of x on segment `segment`, given its projection there.
inline FootPoint foot_point_on_segment(Vector x, std::int32_t segment, SegmentProjection projection,
                                       const ContactSurface& surface) {
  const Segment& s = surface.segments[segment];
  const Vector first = surface.vertex(s.first);
  const Vector second = surface.vertex(s.second);
  const Vector direction = second - first;
  const double segment_length = length(direction);
  // Two boundary particles in one place have no normal and exert no force.
  const Vector segment_normal = segment_length > 0.0 ? left_normal(direction) / segment_length : Vector{};
  FootPoint foot{segment, projection.fraction, projection.at_vertex, segment_normal, 0.0};
  if (!projection.at_vertex) {
    foot.distance = dot(x - first, segment_normal);
    return foot;
  }
  const bool at_first = projection.fraction == 0.0;
  const Vector from_vertex = x - (at_first ? first : second);
  const double r = length(from_vertex);
  if (r == 0.0) return foot;
  double side = 1.0;
  const std::int32_t neighbour = at_first ? s.previous_segment : s.next_segment;
  if (neighbour >= 0) {
    const Segment& n = surface.segments[neighbour];
    const Vector neighbour_direction = surface.vertex(n.second) - surface.vertex(n.first);
    side = at_first ? side_of_vertex(neighbour_direction, direction, from_vertex)
                    : side_of_vertex(direction, neighbour_direction, from_vertex);
  }
  foot.normal = (side / r) * from_vertex;
  foot.distance = side * r;
  return foot;
}

/// The nearest foot point of x on the segments named in `candidates`, which ascend: of equally near ones the lowest.
inline FootPoint nearest_foot_point(Vector x, std::span<const std::int32_t> candidates, const ContactSurface& surface) {
  std::int32_t nearest = -1;
  SegmentProjection projection;
  for (const std::int32_t candidate : candidates) {
    const Segment& s = surface.segments[candidate];
    const SegmentProjection p = project_on_segment(x, surface.vertex(s.first), surface.vertex(s.second));
    if (nearest < 0 || p.squared_distance < projection.squared_distance) {
      nearest = candidate;
      projection = p;
    }
  }
  return nearest < 0 ? FootPoint{} : foot_point_on_segment(x, nearest, projection, surface);
}

}  // namespace sphdrop
