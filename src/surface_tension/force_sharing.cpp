#include "surface_tension/force_sharing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "particles/pack.hpp"
#include "sph/cell_grid.hpp"
#include "surface_tension/node_lanes.hpp"

namespace sphdrop {

namespace {

constexpr auto lanes = static_cast<std::size_t>(pack_size);

/// Entries of a list are added up so many at a time: lists of nearly the same length then end alike, as the processor
/// expects.
constexpr std::int32_t unrolled = 4;
constexpr std::int32_t rounded_up(std::int32_t count) {
  return (count + unrolled - 1) / unrolled * unrolled;
}

}  // namespace

void ForceSharing::rebuild(std::span<const Vector> centres, std::span<const Vector> positions,
                           std::span<const std::int32_t> order, double reach) {
  assert(order.size() == positions.size() && reach > 0.0);
  const std::size_t nodes = centres.size();
  std::vector<double> node_x(nodes), node_y(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    node_x[node] = centres[node].x;
    node_y[node] = centres[node].y;
  }
  const CellGrid grid(node_x, node_y, reach);

  pairs_.clear();
  candidate_count_.assign(nodes, 0);
  for (const std::int32_t i : order) {
    const Vector position = positions[static_cast<std::size_t>(i)];
    grid.for_each_near(position, [&](std::int32_t near_node) {
      const auto node = static_cast<std::size_t>(near_node);
      if (squared_length(position - centres[node]) > reach * reach) return;
      pairs_.push_back({near_node, i});
      ++candidate_count_[node];
    });
  }
  shares_.resize(positions.size() + 1);
  force_per_weight_.resize(nodes);
  place_in_slices();
}

void ForceSharing::place_in_slices() {
  const std::size_t nodes = candidate_count_.size();
  const std::size_t slices = (nodes + lanes - 1) / lanes;
  node_of_lane_.resize(slices * lanes);
  std::iota(node_of_lane_.begin(), node_of_lane_.end(), 0);
  std::sort(node_of_lane_.begin(), node_of_lane_.begin() + static_cast<std::ptrdiff_t>(nodes),
            [&](std::int32_t a, std::int32_t b) {
              return std::pair(candidate_count_[static_cast<std::size_t>(a)], a) <
                     std::pair(candidate_count_[static_cast<std::size_t>(b)], b);
            });
  // Lanes beyond the last node repeat it; they have no candidates.
  for (std::size_t lane = nodes; lane < slices * lanes; ++lane) node_of_lane_[lane] = node_of_lane_[nodes - 1];

  slice_start_.assign(slices + 1, 0);
  slice_end_.resize(slices);
  first_entry_.resize(nodes);
  for (std::size_t slice = 0; slice < slices; ++slice) {
    std::int32_t longest = 0;
    for (std::size_t lane = 0; lane < lanes && slice * lanes + lane < nodes; ++lane) {
      const auto node = static_cast<std::size_t>(node_of_lane_[slice * lanes + lane]);
      longest = std::max(longest, candidate_count_[node]);
      first_entry_[node] = slice_start_[slice] + static_cast<std::int32_t>(lane);
    }
    slice_end_[slice] = slice_start_[slice] + longest * static_cast<std::int32_t>(lanes);
    slice_start_[slice + 1] = slice_start_[slice] + rounded_up(longest) * static_cast<std::int32_t>(lanes);
  }
  const auto far_particle = static_cast<std::int32_t>(shares_.size()) - 1;
  candidates_.assign(static_cast<std::size_t>(slice_start_.back()), far_particle);
  std::vector<std::int32_t> entry = first_entry_;
  for (const Pair& pair : pairs_) {
    std::int32_t& place = entry[static_cast<std::size_t>(pair.node)];
    candidates_[static_cast<std::size_t>(place)] = pair.candidate;
    place += static_cast<std::int32_t>(lanes);
  }
  weights_.assign(candidates_.size(), 0.0);
}

std::span<const Vector> ForceSharing::share(std::span<const Vector> points, std::span<const Vector> forces,
                                            std::span<const Vector> positions, const SmoothingKernel& kernel) {
  assert(points.size() == candidate_count_.size() && forces.size() == points.size());
  assert(positions.size() == shares_.size() && (positions.empty() || positions.back() == far_away));
  points_without_particles_ = 0;
  if (!points.empty())
    std::visit([&](const auto& chosen) { evaluate_kernel(points, forces, positions, chosen); }, kernel);
  sum_over_points();
  return std::span<const Vector>(shares_).first(shares_.empty() ? 0 : shares_.size() - 1);
}

template <class Kernel>
[[gnu::flatten]] void ForceSharing::evaluate_kernel(std::span<const Vector> points, std::span<const Vector> forces,
                                                    std::span<const Vector> positions, const Kernel& kernel) {
  using std::sqrt;
  for (std::size_t slice = 0; slice < slice_end_.size(); ++slice) {
    const std::int32_t* const node = node_of_lane_.data() + slice * lanes;
    const Components<Pack> point = collect_lanes(points, node);
    Pack sum = 0.0;
    const auto last = static_cast<std::size_t>(slice_end_[slice]);
    for (auto entry = static_cast<std::size_t>(slice_start_[slice]); entry < last; entry += lanes) {
      const std::int32_t* const candidate = candidates_.data() + entry;
      const Components<Pack> separation = point - collect_lanes(positions, candidate);
      const Pack distance = sqrt(separation.x * separation.x + separation.y * separation.y);
      const Pack weight = kernel.value(distance);
      store(weight, weights_.data() + entry);
      sum += weight;
    }
    for (std::size_t lane = 0; lane < std::min(lanes, points.size() - slice * lanes); ++lane) {
      const double weight_sum = sum[lane];
      const bool has_particles = weight_sum > 0.0;
      const auto k = static_cast<std::size_t>(node[lane]);
      points_without_particles_ += has_particles ? 0 : 1;
      force_per_weight_[k] = has_particles ? forces[k] / weight_sum : Vector{};
    }
  }
}

void ForceSharing::sum_over_points() {
  std::fill(shares_.begin(), shares_.end(), Vector{});
  Vector* const shares = shares_.data();
  for (std::size_t node = 0; node < candidate_count_.size(); ++node) {
    const Vector force = force_per_weight_[node];
    const std::int32_t* candidate = candidates_.data() + first_entry_[node];
    const double* weight = weights_.data() + first_entry_[node];
    for (std::int32_t k = 0; k < rounded_up(candidate_count_[node]); k += unrolled)
      for (std::int32_t n = 0; n < unrolled; ++n, candidate += lanes, weight += lanes)
        shares[*candidate] += *weight * force;
  }
}

}  // namespace sphdrop
