#include "surface_tension/boundary_detection.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

constexpr auto lanes = static_cast<std::size_t>(pack_size);
constexpr std::size_t whole_vectors(std::size_t count) {
  return (count + lanes - 1) / lanes * lanes;
}

/// As wide as compilers make the loops that fill what is loaded: a load of what two stores have written waits for both.
using LoopPack =
    std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, std::min<std::size_t>(lanes, 4)>>;

/// Directions closer than this (radians) count as one. Gaps narrower are covered: on symmetric arrangements several
/// circles meet in one point, where round-off alone decides whether there is a gap.
constexpr double angle_tolerance = 1e-9;
constexpr double full_turn = 4.0;
/// More than any cosine.
constexpr double out_of_reach = 2.0;

/// The angle from `from` counterclockwise to the direction (to_x, to_y), both unit vectors, as a monotone function of
/// it that needs no trigonometry: 0 to 4 for a full turn, and equal to the angle itself where that is small.
double angle_ahead(Vector from, double to_x, double to_y) {
  const double x = from.x * to_x + from.y * to_y;
  const double y = from.x * to_y - from.y * to_x;
  const bool is_left = y >= 0.0;
  const bool is_ahead = x >= 0.0;
  // By quarters y/(x + y), 1 - x/(y - x), 2 + y/(x + y), 3 + x/(x - y); without branches, so that a compiler can do
  // several at a time.
  const double quarters = is_left ? (is_ahead ? 0.0 : 1.0) : (is_ahead ? 3.0 : 2.0);
  const double part = is_left ? (is_ahead ? y : -x) : (is_ahead ? x : y);
  const double whole = is_left ? (is_ahead ? x + y : y - x) : (is_ahead ? x - y : x + y);
  return quarters + part / whole;
}

double angle_ahead(Vector from, Vector to) {
  return angle_ahead(from, to.x, to.y);
}

bool same_direction(Vector a, Vector b) {
  return std::abs(cross(a, b)) <= angle_tolerance && dot(a, b) > 0.0;
}

}  // namespace

ArcFinder::ArcFinder(double radius)
    : largest_squared_distance_(4.0 * radius * radius * (1.0 - 1e-14)),
      inverse_diameter_(1.0 / (2.0 * radius)),
      inverse_squared_diameter_(1.0 / (4.0 * radius * radius)) {
  assert(radius > 0.0);
}

void ArcFinder::find(std::int64_t particle, Vector centre, std::span<const std::int64_t> neighbour_ids,
                     std::span<const Vector> neighbour_positions, std::vector<Arc>& arcs) {
  assert(neighbour_ids.size() == neighbour_positions.size());
  start();
  for (std::size_t k = 0; k < neighbour_ids.size(); ++k) {
    if (neighbour_ids[k] == particle) continue;
    const Vector separation = neighbour_positions[k] - centre;
    const double squared_distance = squared_length(separation);
    if (squared_distance >= largest_squared_distance_) continue;
    if (squared_distance > 0.0)
      add(separation, squared_distance, neighbour_ids[k]);
    else if (neighbour_ids[k] < particle)
      return;
  }
  append_arcs(particle, arcs);
}

void ArcFinder::make_room(std::size_t wanted) {
  const std::size_t room = std::max<std::size_t>(std::bit_ceil(wanted), 64);  // whole vectors, of any machine
  neighbours_.resize(room);
  for (auto* column :
       {&separation_x_, &separation_y_, &squared_distances_, &start_x_, &start_y_, &end_x_, &end_y_, &values_})
    column->resize(room);
}

void ArcFinder::find_covers() {
  using std::sqrt;
  for (std::size_t k = count_; k % lanes != 0; ++k) {
    separation_x_[k] = separation_x_[count_ - 1];
    separation_y_[k] = separation_y_[count_ - 1];
    squared_distances_[k] = squared_distances_[count_ - 1];
  }
  for (std::size_t k = 0; k < count_; k += lanes) {
    // The neighbour's direction turned by -/+ acos(r / 2R).
    const Pack x = load(&separation_x_[k]), y = load(&separation_y_[k]);
    const Pack along_x = Pack(inverse_diameter_) * x, along_y = Pack(inverse_diameter_) * y;
    const Pack sine_over_distance = sqrt(Pack(1.0) / load(&squared_distances_[k]) - Pack(inverse_squared_diameter_));
    const Pack across_x = sine_over_distance * -y, across_y = sine_over_distance * x;
    store(along_x - across_x, &start_x_[k]);
    store(along_y - across_y, &start_y_[k]);
    store(along_x + across_x, &end_x_[k]);
    store(along_y + across_y, &end_y_[k]);
  }
}

bool ArcFinder::is_farther(Place a, Place b) const {
  return squared_distances_[a] != squared_distances_[b] ? squared_distances_[a] > squared_distances_[b]
                                                        : neighbours_[a] < neighbours_[b];
}

double ArcFinder::least(const std::vector<double>& values) const {
  using std::experimental::element_aligned, std::experimental::min;
  LoopPack least_of_lane(values.data(), element_aligned);
  for (std::size_t k = LoopPack::size(); k < count_; k += LoopPack::size())
    least_of_lane = min(least_of_lane, LoopPack(&values[k], element_aligned));
  return hmin(least_of_lane);
}

ArcFinder::Place ArcFinder::place_of(double value, const std::vector<double>& values) const {
  // Mostly one has it: its place is the sum of the places of all that do.
  const double* const of = values.data();
  const auto end = static_cast<std::int64_t>(whole_vectors(count_));
  std::int64_t holders = 0, places = 0;
  for (std::int64_t k = 0; k < end; ++k) {
    holders += of[k] == value ? 1 : 0;
    places += of[k] == value ? k : 0;
  }
  if (holders == 1) return static_cast<Place>(places);
  Place best = count_;
  for (Place k = 0; k < count_; ++k)
    if (of[k] == value && (best == count_ || neighbours_[k] < neighbours_[best])) best = k;
  return best;
}

ArcFinder::Place ArcFinder::nearest() const {
  return place_of(least(squared_distances_), squared_distances_);
}

ArcFinder::Place ArcFinder::farthest_reaching(Vector direction) {
  const double *start_x = start_x_.data(), *start_y = start_y_.data(), *end_x = end_x_.data(), *end_y = end_y_.data();
  double* __restrict cosines = values_.data();  // they fall with the angle, which is below half a turn
  for (std::size_t k = 0; k < whole_vectors(count_); ++k) {
    const double cosine = direction.x * end_x[k] + direction.y * end_y[k];
    const double after_start = start_x[k] * direction.y - start_y[k] * direction.x;
    const double before_end = direction.x * end_y[k] - direction.y * end_x[k];
    const double if_not_ended = before_end <= angle_tolerance ? out_of_reach : cosine;
    cosines[k] = after_start < -angle_tolerance ? out_of_reach : if_not_ended;
  }
  const double lowest = least(values_);
  return lowest < out_of_reach ? place_of(lowest, values_) : count_;
}

ArcFinder::Place ArcFinder::first_to_start(Vector direction) {
  const double *start_x = start_x_.data(), *start_y = start_y_.data();
  double* __restrict angles = values_.data();
  for (std::size_t k = 0; k < whole_vectors(count_); ++k) angles[k] = angle_ahead(direction, start_x[k], start_y[k]);
  return place_of(least(values_), values_);
}

ArcFinder::Place ArcFinder::farthest_with_direction(Place k, const std::vector<double>& x,
                                                    const std::vector<double>& y) const {
  const Vector wanted{x[k], y[k]};
  const double *of_x = x.data(), *of_y = y.data();
  std::int64_t holders = 0;
  for (std::size_t j = 0; j < whole_vectors(count_); ++j) {
    const bool is_parallel = std::abs(of_x[j] * wanted.y - of_y[j] * wanted.x) <= angle_tolerance;
    holders += is_parallel && of_x[j] * wanted.x + of_y[j] * wanted.y > 0.0 ? 1 : 0;
  }
  if (holders == 1) return k;
  Place farthest = k;
  for (Place j = 0; j < count_; ++j)
    if (same_direction({x[j], y[j]}, wanted) && is_farther(j, farthest)) farthest = j;
  return farthest;
}

ArcFinder::Place ArcFinder::farthest_with_end_of(Place k) const {
  return farthest_with_direction(k, end_x_, end_y_);
}

ArcFinder::Place ArcFinder::farthest_with_start_of(Place k) const {
  return farthest_with_direction(k, start_x_, start_y_);
}

void ArcFinder::append_arcs(std::int64_t particle, std::vector<Arc>& arcs) {
  if (count_ == 0) {
    arcs.push_back({particle, particle, particle, {1.0, 0.0}, {1.0, 0.0}});
    return;
  }
  find_covers();
  Place reached = nearest();  // the last one whose cover the walk went to the end of
  const Vector origin = end_of(reached);
  Vector direction = origin;
  double remaining = full_turn;
  for (std::size_t step = 0; step <= 2 * count_; ++step) {
    if (const Place cover = farthest_reaching(direction); cover < count_) {
      if (angle_ahead(direction, end_of(cover)) >= remaining - angle_tolerance) return;
      reached = cover;
      direction = end_of(cover);
    } else {
      // Where covers begin or end together, the one of the farthest neighbour is at the gap: just outside the circle,
      // the others lie behind it. That neighbour sees it the same way, so the arcs of both fit together.
      const Place previous = farthest_with_end_of(reached);
      const Place next = farthest_with_start_of(first_to_start(direction));
      arcs.push_back({particle, neighbours_[previous], neighbours_[next], end_of(previous), start_of(next)});
      direction = start_of(next);
    }
    remaining = angle_ahead(direction, origin);
  }
  assert(false && "the walk round the circle must come back to its beginning");
}

}  // namespace sphdrop
