#include "contact/contact_surface.hpp"

#include <algorithm>
#include <cassert>

namespace sphdrop {

std::vector<Segment> segments_of_polylines(std::span<const std::vector<std::int32_t>> polylines) {
  std::vector<Segment> segments;
  for (const auto& polyline : polylines) {
    if (polyline.size() < 2) continue;
    const auto begin = static_cast<std::int32_t>(segments.size());
    const auto end = begin + static_cast<std::int32_t>(polyline.size()) - 1;
    for (std::int32_t s = begin; s < end; ++s)
      segments.push_back({polyline[s - begin], polyline[s - begin + 1], s - 1, s + 1});
    const bool is_closed = polyline.size() > 3 && polyline.front() == polyline.back();
    segments[begin].previous_segment = is_closed ? end - 1 : -1;
    segments[end - 1].next_segment = is_closed ? begin : -1;
  }
  return segments;
}

SurfacePart part_of_surface(std::span<const Segment> segments, std::span<const char> is_wanted) {
  assert(segments.size() == is_wanted.size());
  std::vector<char> is_kept(is_wanted.begin(), is_wanted.end());
  SurfacePart part;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!is_wanted[s]) continue;
    if (segments[s].previous_segment >= 0) is_kept[segments[s].previous_segment] = 1;
    if (segments[s].next_segment >= 0) is_kept[segments[s].next_segment] = 1;
  }
  std::vector<std::int32_t> new_segment(segments.size(), -1);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!is_kept[s]) continue;
    new_segment[s] = static_cast<std::int32_t>(part.original_segments.size());
    part.original_segments.push_back(static_cast<std::int32_t>(s));
    part.original_vertices.push_back(segments[s].first);
    part.original_vertices.push_back(segments[s].second);
  }
  auto& vertices = part.original_vertices;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  const auto new_vertex = [&](std::int32_t vertex) {
    return static_cast<std::int32_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  };
  const auto renumbered = [&](std::int32_t segment) { return segment < 0 ? -1 : new_segment[segment]; };
  for (const std::int32_t s : part.original_segments) {
    const Segment& old = segments[s];
    part.segments.push_back({new_vertex(old.first), new_vertex(old.second), renumbered(old.previous_segment),
                             renumbered(old.next_segment)});
  }
  return part;
}

}  // namespace sphdrop
