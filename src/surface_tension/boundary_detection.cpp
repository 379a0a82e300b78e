#include "surface_tension/boundary_detection.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace sphdrop {

namespace {

/// Directions closer than this (radians) count as one. Gaps narrower are covered: on symmetric arrangements several
/// circles meet in one point, where round-off alone decides whether there is a gap.
constexpr double angle_tolerance = 1e-9;
constexpr double full_turn = 4.0;

/// The angle from `from` counterclockwise to `to`, both unit vectors, as a monotone function of it that needs no
/// trigonometry: 0 to 4 for a full turn, and equal to the angle itself where that is small.
double angle_ahead(Vector from, Vector to) {
  const double x = dot(from, to);
  const double y = cross(from, to);
  if (y >= 0.0) return x >= 0.0 ? y / (x + y) : 1.0 - x / (y - x);
  return x < 0.0 ? 2.0 + y / (x + y) : 3.0 + x / (x - y);
}

bool same_direction(Vector a, Vector b) {
  return std::abs(cross(a, b)) <= angle_tolerance && dot(a, b) > 0.0;
}

}  // namespace

ArcFinder::ArcFinder(double radius)
    : largest_squared_distance_(4.0 * radius * radius * (1.0 - 1e-14)),
      near_squared_distance_(0.58 * radius * radius),
      inverse_diameter_(1.0 / (2.0 * radius)),
      inverse_squared_diameter_(1.0 / (4.0 * radius * radius)) {
  assert(radius > 0.0);
}

ArcFinder::Cover ArcFinder::cover_by(Vector separation, double squared_distance, std::int64_t neighbour) const {
  // The neighbour's direction turned by -/+ acos(r / 2R).
  const Vector along = inverse_diameter_ * separation;
  const Vector across = std::sqrt(1.0 / squared_distance - inverse_squared_diameter_) * left_normal(separation);
  return {along - across, along + across, squared_distance, neighbour};
}

const ArcFinder::Cover* ArcFinder::farthest_reaching(Vector direction) const {
  const Cover* best = nullptr;
  double best_cosine = 1.0;
  for (const Cover& cover : covers_) {
    if (cross(cover.start, direction) < -angle_tolerance || cross(direction, cover.end) <= angle_tolerance) continue;
    const double cosine = dot(direction, cover.end);  // falls with the angle, which is below half a turn
    if (best == nullptr || cosine < best_cosine || (cosine == best_cosine && cover.neighbour < best->neighbour)) {
      best = &cover;
      best_cosine = cosine;
    }
  }
  return best;
}

bool ArcFinder::is_nearer(const Cover& a, const Cover& b) {
  return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.neighbour < b.neighbour;
}

bool ArcFinder::is_farther(const Cover& a, const Cover& b) {
  return a.squared_distance != b.squared_distance ? a.squared_distance > b.squared_distance : a.neighbour < b.neighbour;
}

bool ArcFinder::is_covered_by(Vector centre, std::span<const Vector> neighbour_positions) const {
  unsigned octants = 0;
  for (const Vector position : neighbour_positions) octants |= octant_of_near(position - centre);
  return covers_circle(octants);
}

void ArcFinder::find(std::int64_t particle, Vector centre, std::span<const std::int64_t> neighbour_ids,
                     std::span<const Vector> neighbour_positions, std::vector<Arc>& arcs) {
  assert(neighbour_ids.size() == neighbour_positions.size());
  if (is_covered_by(centre, neighbour_positions)) return;

  covers_.clear();
  for (std::size_t k = 0; k < neighbour_ids.size(); ++k) {
    if (neighbour_ids[k] == particle) continue;
    const Vector separation = neighbour_positions[k] - centre;
    const double squared_distance = squared_length(separation);
    if (squared_distance >= largest_squared_distance_) continue;
    if (squared_distance > 0.0)
      covers_.push_back(cover_by(separation, squared_distance, neighbour_ids[k]));
    else if (neighbour_ids[k] < particle)
      return;
  }
  append_uncovered(particle, arcs);
}

const ArcFinder::Cover& ArcFinder::first_to_start(Vector direction) const {
  const Cover* first = &covers_.front();
  double gap = angle_ahead(direction, first->start);
  for (const Cover& cover : covers_) {
    const double ahead = angle_ahead(direction, cover.start);
    if (ahead >= gap) continue;
    first = &cover;
    gap = ahead;
  }
  return *first;
}

const ArcFinder::Cover& ArcFinder::outermost_ending_with(const Cover& end) const {
  const Cover* outermost = &end;
  for (const Cover& cover : covers_)
    if (same_direction(cover.end, end.end) && is_farther(cover, *outermost)) outermost = &cover;
  return *outermost;
}

const ArcFinder::Cover& ArcFinder::outermost_starting_with(const Cover& start) const {
  const Cover* outermost = &start;
  for (const Cover& cover : covers_)
    if (same_direction(cover.start, start.start) && is_farther(cover, *outermost)) outermost = &cover;
  return *outermost;
}

void ArcFinder::append_uncovered(std::int64_t particle, std::vector<Arc>& arcs) const {
  if (covers_.empty()) {
    arcs.push_back({particle, particle, particle, {1.0, 0.0}, {1.0, 0.0}});
    return;
  }
  const Cover& nearest = *std::min_element(covers_.begin(), covers_.end(), is_nearer);
  const Vector origin = nearest.end;
  const Cover* reached = &nearest;  // the last cover that the walk went to the end of
  Vector direction = origin;
  double remaining = full_turn;
  for (std::size_t step = 0; step <= 2 * covers_.size(); ++step) {
    if (const Cover* cover = farthest_reaching(direction)) {
      if (angle_ahead(direction, cover->end) >= remaining - angle_tolerance) return;
      reached = cover;
      direction = cover->end;
    } else {
      // Where covers begin or end together, the one of the farthest neighbour is at the gap: just outside the circle,
      // the others lie behind it. That neighbour sees it the same way, so the arcs of both fit together.
      const Cover& previous = outermost_ending_with(*reached);
      const Cover& next = outermost_starting_with(first_to_start(direction));
      arcs.push_back({particle, previous.neighbour, next.neighbour, previous.end, next.start});
      direction = next.start;
    }
    remaining = angle_ahead(direction, origin);
  }
  assert(!"the walk round the circle must come back to its beginning");
}

}  // namespace sphdrop
