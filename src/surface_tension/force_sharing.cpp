#include "surface_tension/force_sharing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "particles/pack.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {

namespace {

constexpr auto lanes = static_cast<std::size_t>(pack_size);

/// Its square is still finite, its distance from anything beyond any kernel's support.
constexpr double far_away = 1e150;

}  // namespace

void ForceSharing::rebuild(std::span<const Vector> centres, std::span<const double> x, std::span<const double> y,
                           double reach) {
  assert(x.size() == y.size() && reach > 0.0);
  const std::size_t nodes = centres.size();
  std::vector<double> node_x(nodes), node_y(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    node_x[node] = centres[node].x;
    node_y[node] = centres[node].y;
  }
  const CellGrid grid(node_x, node_y, reach);

  struct Pair {
    std::int32_t node, candidate;
  };
  std::vector<Pair> pairs;  // particle after particle, so each node's candidates come in ascending order
  particles_.clear();
  candidate_count_.assign(nodes, 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vector position = {x[i], y[i]};
    bool is_candidate = false;
    grid.for_each_near(position, [&](std::int32_t near_node) {
      const auto node = static_cast<std::size_t>(near_node);
      if (squared_length(position - centres[node]) > reach * reach) return;
      pairs.push_back({near_node, static_cast<std::int32_t>(particles_.size())});
      ++candidate_count_[node];
      is_candidate = true;
    });
    if (is_candidate) particles_.push_back(static_cast<std::int32_t>(i));
  }

  const std::size_t slices = (nodes + lanes - 1) / lanes;
  slice_start_.assign(slices + 1, 0);
  for (std::size_t slice = 0; slice < slices; ++slice) {
    std::int32_t longest = 0;
    for (std::size_t node = slice * lanes; node < std::min(nodes, (slice + 1) * lanes); ++node)
      longest = std::max(longest, candidate_count_[node]);
    slice_start_[slice + 1] = slice_start_[slice] + longest * static_cast<std::int32_t>(lanes);
  }
  const auto far_particle = static_cast<std::int32_t>(particles_.size());
  candidates_.assign(static_cast<std::size_t>(slice_start_.back()), far_particle);
  std::vector<std::size_t> place(nodes);
  for (std::size_t node = 0; node < nodes; ++node)
    place[node] = static_cast<std::size_t>(slice_start_[node / lanes]) + node % lanes;
  for (const Pair& pair : pairs) {
    std::size_t& entry = place[static_cast<std::size_t>(pair.node)];
    candidates_[entry] = pair.candidate;
    entry += lanes;
  }

  weights_.resize(candidates_.size());
  force_per_weight_.resize(nodes);
  candidate_x_.resize(particles_.size() + 1);
  candidate_y_.resize(particles_.size() + 1);
  inverse_mass_.resize(particles_.size());
  shares_.resize(particles_.size());
}

std::size_t ForceSharing::share(std::span<const Vector> points, std::span<const Vector> forces,
                                std::span<const double> x, std::span<const double> y, std::span<const double> masses,
                                const SmoothingKernel& kernel, std::span<double> acceleration_x,
                                std::span<double> acceleration_y) {
  assert(points.size() == candidate_count_.size() && forces.size() == points.size());
  assert(x.size() == y.size() && masses.size() == x.size());
  assert(acceleration_x.size() == x.size() && acceleration_y.size() == x.size());
  copy_candidates(x, y, masses);
  std::visit([&](const auto& chosen) { evaluate_kernel(points, forces, chosen); }, kernel);
  sum_over_points();
  for (std::size_t c = 0; c < particles_.size(); ++c) {
    const auto i = static_cast<std::size_t>(particles_[c]);
    acceleration_x[i] += shares_[c].x * inverse_mass_[c];
    acceleration_y[i] += shares_[c].y * inverse_mass_[c];
  }
  return points_without_particles_;
}

void ForceSharing::copy_candidates(std::span<const double> x, std::span<const double> y,
                                   std::span<const double> masses) {
  for (std::size_t c = 0; c < particles_.size(); ++c) {
    const auto i = static_cast<std::size_t>(particles_[c]);
    candidate_x_[c] = x[i];
    candidate_y_[c] = y[i];
    inverse_mass_[c] = masses[i];
  }
  for (double& mass : inverse_mass_) mass = 1.0 / mass;  // apart, so that it is vectorised
  candidate_x_.back() = far_away;
  candidate_y_.back() = far_away;
}

template <class Kernel>
void ForceSharing::evaluate_kernel(std::span<const Vector> points, std::span<const Vector> forces,
                                   const Kernel& kernel) {
  using std::sqrt;
  points_without_particles_ = 0;
  const double* const candidate_x = candidate_x_.data();
  const double* const candidate_y = candidate_y_.data();
  for (std::size_t slice = 0; slice + 1 < slice_start_.size(); ++slice) {
    const std::size_t first_node = slice * lanes;
    const std::size_t nodes = std::min(lanes, points.size() - first_node);
    // Lanes beyond the last node repeat it; they have no candidates.
    const auto node = [&](std::size_t lane) { return first_node + std::min(lane, nodes - 1); };
    const Pack point_x([&](auto lane) { return points[node(lane)].x; });
    const Pack point_y([&](auto lane) { return points[node(lane)].y; });
    Pack sum = 0.0;
    const auto last = static_cast<std::size_t>(slice_start_[slice + 1]);
    for (auto entry = static_cast<std::size_t>(slice_start_[slice]); entry < last; entry += lanes) {
      const std::int32_t* const candidate = candidates_.data() + entry;
      const Pack separation_x = point_x - Pack([&](auto lane) { return candidate_x[candidate[lane]]; });
      const Pack separation_y = point_y - Pack([&](auto lane) { return candidate_y[candidate[lane]]; });
      const Pack distance = sqrt(separation_x * separation_x + separation_y * separation_y);
      const Pack weight = kernel.value(distance);
      store(weight, weights_.data() + entry);
      sum += weight;
    }
    for (std::size_t lane = 0; lane < nodes; ++lane) {
      const double weight_sum = sum[lane];
      const bool has_particles = weight_sum > 0.0;
      points_without_particles_ += has_particles ? 0 : 1;
      force_per_weight_[first_node + lane] = has_particles ? forces[first_node + lane] / weight_sum : Vector{};
    }
  }
}

void ForceSharing::sum_over_points() {
  std::fill(shares_.begin(), shares_.end(), Vector{});
  for (std::size_t node = 0; node < candidate_count_.size(); ++node) {
    const Vector force = force_per_weight_[node];
    auto entry = static_cast<std::size_t>(slice_start_[node / lanes]) + node % lanes;
    for (std::int32_t k = 0; k < candidate_count_[node]; ++k, entry += lanes)
      shares_[static_cast<std::size_t>(candidates_[entry])] += weights_[entry] * force;
  }
}

}  // namespace sphdrop
