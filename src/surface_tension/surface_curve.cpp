#include "surface_tension/surface_curve.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace sphdrop {

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// Unit vector half-way from start counterclockwise to end. Of the sum and the difference of the two directions, both
/// of which give it, the longer one is taken.
Vector middle_direction(const Arc& arc) {
  if (dot(arc.start, arc.end) <= 0.0) return unit(right_normal(arc.end - arc.start));
  const Vector bisector = unit(arc.start + arc.end);
  return cross(arc.start, arc.end) > 0.0 ? bisector : -bisector;
}

/// The arcs in the order of (particle, previous). This pair is unique: two circles meet in two points, and going
/// counterclockwise one leaves `previous` for `particle` at only one of them. The rest of the key matters only for
/// arcs spoilt by round-off.
std::vector<std::size_t> canonical_order(std::span<const Arc> arcs) {
  std::vector<std::size_t> order(arcs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t k) {
      return std::make_tuple(arcs[k].particle, arcs[k].previous, arcs[k].next, arcs[k].start.x, arcs[k].start.y);
    };
    return key(a) < key(b);
  });
  return order;
}

/// For each place in `order` the place of the arc that follows along the curve: a permutation.
std::vector<std::size_t> successors(std::span<const Arc> arcs, std::span<const Vector> centres, double radius,
                                    std::span<const std::size_t> order, std::int32_t& unmatched_arcs) {
  std::vector<std::size_t> successor(order.size(), none);
  std::vector<bool> has_predecessor(order.size(), false);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Arc& arc = arcs[order[k]];
    const auto wanted = std::make_pair(arc.next, arc.particle);
    auto place = std::lower_bound(order.begin(), order.end(), wanted, [&](std::size_t candidate, const auto& key) {
      return std::make_pair(arcs[candidate].particle, arcs[candidate].previous) < key;
    });
    for (; place != order.end() && arcs[*place].particle == arc.next && arcs[*place].previous == arc.particle;
         ++place) {
      const auto follower = static_cast<std::size_t>(place - order.begin());
      if (has_predecessor[follower]) continue;
      successor[k] = follower;
      has_predecessor[follower] = true;
      break;
    }
  }

  for (std::size_t k = 0; k < order.size(); ++k) {
    if (successor[k] != none) continue;
    const Vector end = centres[order[k]] + radius * arcs[order[k]].end;
    std::size_t nearest = none;
    double nearest_squared_distance = 0.0;
    for (std::size_t follower = 0; follower < order.size(); ++follower) {
      if (has_predecessor[follower]) continue;
      const Vector start = centres[order[follower]] + radius * arcs[order[follower]].start;
      const double squared_distance = squared_length(start - end);
      if (nearest == none || squared_distance < nearest_squared_distance) {
        nearest = follower;
        nearest_squared_distance = squared_distance;
      }
    }
    assert(nearest != none);  // as many starts are loose as ends
    successor[k] = nearest;
    has_predecessor[nearest] = true;
    constexpr double coincidence = 1e-6;
    if (nearest_squared_distance > coincidence * coincidence * radius * radius) ++unmatched_arcs;
  }
  return successor;
}

}  // namespace

SurfaceCurves connect_arcs(std::span<const Arc> arcs, std::span<const Vector> centres, double radius) {
  assert(centres.size() == arcs.size());
  SurfaceCurves curves;
  const std::vector<std::size_t> order = canonical_order(arcs);
  const std::vector<std::size_t> successor = successors(arcs, centres, radius, order, curves.unmatched_arcs);

  std::vector<bool> is_placed(order.size(), false);
  curves.nodes.reserve(order.size());
  for (std::size_t first = 0; first < order.size(); ++first) {
    if (is_placed[first]) continue;
    for (std::size_t k = first; !is_placed[k]; k = successor[k]) {
      is_placed[k] = true;
      curves.nodes.push_back({arcs[order[k]].particle, middle_direction(arcs[order[k]]), centres[order[k]]});
    }
    curves.curve_start.push_back(static_cast<std::int32_t>(curves.nodes.size()));
  }
  return curves;
}

}  // namespace sphdrop
