#pragma once
// The uncovered arcs of one particle by a walk over all covers one after another: what vectors must give, bit by bit.

#include <cmath>
#include <cstdint>
#include <vector>

#include "drops.hpp"

namespace sphdrop::test {

struct Cover {
  Vector start, end;
  double squared_distance;
  std::int64_t neighbour;
};

inline double reference_angle_ahead(Vector from, Vector to) {
  const double x = dot(from, to);
  const double y = cross(from, to);
  if (y >= 0.0) return x >= 0.0 ? y / (x + y) : 1.0 - x / (y - x);
  return x < 0.0 ? 2.0 + y / (x + y) : 3.0 + x / (x - y);
}

/// Global id = index.
inline void append_reference_arcs(const Positions& positions, std::size_t i, double radius, std::vector<Arc>& arcs) {
  constexpr double tolerance = 1e-9;
  std::vector<Cover> covers;
  for (std::size_t j = 0; j < positions.size(); ++j) {
    const Vector separation = positions[j] - positions[i];
    const double squared = squared_length(separation);
    if (j == i || squared >= 4.0 * radius * radius * (1.0 - 1e-14)) continue;
    if (squared == 0.0 && j < i) return;
    if (squared == 0.0) continue;
    const Vector along = 1.0 / (2.0 * radius) * separation;
    const Vector across = std::sqrt(1.0 / squared - 1.0 / (4.0 * radius * radius)) * left_normal(separation);
    covers.push_back({along - across, along + across, squared, static_cast<std::int64_t>(j)});
  }
  const auto particle = static_cast<std::int64_t>(i);
  if (covers.empty()) {
    arcs.push_back({particle, particle, particle, {1.0, 0.0}, {1.0, 0.0}});
    return;
  }
  const auto same = [&](Vector a, Vector b) { return std::abs(cross(a, b)) <= tolerance && dot(a, b) > 0.0; };
  const Cover* reached = &covers[0];
  for (const Cover& cover : covers)
    if (cover.squared_distance < reached->squared_distance) reached = &cover;
  const Vector origin = reached->end;
  Vector direction = origin;
  double remaining = 4.0;
  while (true) {
    const Cover* best = nullptr;
    for (const Cover& cover : covers)
      if (cross(cover.start, direction) >= -tolerance && cross(direction, cover.end) > tolerance &&
          (best == nullptr || dot(direction, cover.end) < dot(direction, best->end)))
        best = &cover;
    if (best != nullptr) {
      if (reference_angle_ahead(direction, best->end) >= remaining - tolerance) return;
      reached = best;
      direction = best->end;
    } else {
      const Cover* next = &covers[0];
      for (const Cover& cover : covers)
        if (reference_angle_ahead(direction, cover.start) < reference_angle_ahead(direction, next->start))
          next = &cover;
      const Cover* previous = reached;
      const Vector gap_end = next->start;
      for (const Cover& cover : covers) {
        if (same(cover.end, direction) && cover.squared_distance > previous->squared_distance) previous = &cover;
        if (same(cover.start, gap_end) && cover.squared_distance > next->squared_distance) next = &cover;
      }
      arcs.push_back({particle, previous->neighbour, next->neighbour, previous->end, next->start});
      direction = next->start;
    }
    remaining = reference_angle_ahead(direction, origin);
  }
}

inline std::vector<Arc> reference_arcs_of(const Positions& positions, double radius = circle_radius) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < positions.size(); ++i) append_reference_arcs(positions, i, radius, arcs);
  return arcs;
}

}  // namespace sphdrop::test
