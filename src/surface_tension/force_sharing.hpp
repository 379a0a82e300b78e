#pragma once
// The surface force shared out over the liquid's particles (32, 33).

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"
#include "sph/kernel.hpp"

namespace sphdrop {

/// The force on a surface point s acts on the particles within 2h of it, in proportion to the kernel:
/// a_i += F_s W_is / (m_i sum_j W_js) (32, 33). The candidates of each point are found once and kept while the
/// particles move a little.
///
/// The sums are in the order in which rebuild() is told of the particles, and over the points in the order of the
/// curves: where the one is that of global ids, the result depends on nothing else, neither on the vectors' width.
class ForceSharing {
 public:
  /// Finds for every node the particles within `reach` (m) of `centres`, by node: the surface points, with reach = 2h
  /// plus what a point and a particle may move towards each other until the next rebuild; or the nodes' particles, with
  /// d/2 more. `positions` (m): of all particles that may take part; `order`: their indices, each once.
  void rebuild(std::span<const Vector> centres, std::span<const Vector> positions, std::span<const std::int32_t> order,
               double reach);

  /// One more place that positions hold for share(), m: the squares are still finite, its distance from anything is
  /// beyond any kernel's support.
  static constexpr Vector far_away{1e150, 1e150};

  /// The force on each particle, m_i a_i, N/m, until the next call. points (m) and forces (N/m): by node; positions by
  /// particle, as in rebuild, but for the place far_away at their end.
  std::span<const Vector> share(std::span<const Vector> points, std::span<const Vector> forces,
                                std::span<const Vector> positions, const SmoothingKernel& kernel);

  /// Of the last share(): points with no particle within 2h, whose force is lost.
  std::size_t points_without_particles() const { return points_without_particles_; }

 private:
  void place_in_slices();
  template <class Kernel>
  void evaluate_kernel(std::span<const Vector> points, std::span<const Vector> forces,
                       std::span<const Vector> positions, const Kernel& kernel);
  void sum_over_points();

  struct Pair {
    std::int32_t node, candidate;
  };
  std::vector<Pair> pairs_;  ///< scratch: particle after particle, so that each node's are in the order given

  // Nodes go in slices, one node a lane of a vector; the candidates at the same place in their lists lie side by side.
  // In a slice are nodes of nearly as many candidates each. Shorter lists are filled up with a particle so far away
  // that its W is an exact zero.
  std::vector<std::int32_t> node_of_lane_;     ///< [slice][lane]
  std::vector<std::int32_t> slice_start_;      ///< first entry of each slice, and their number
  std::vector<std::int32_t> slice_end_;        ///< where W is evaluated up to; then W stays zero
  std::vector<std::int32_t> first_entry_;      ///< by node
  std::vector<std::int32_t> candidate_count_;  ///< by node
  std::vector<std::int32_t> candidates_;

  // Scratch, by entry of candidates_, by node, and by particle.
  std::vector<double> weights_;
  std::vector<Vector> force_per_weight_;
  std::vector<Vector> shares_;  // and for the far-away place
  std::size_t points_without_particles_ = 0;
};

}  // namespace sphdrop
