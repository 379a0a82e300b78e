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
/// The sums are in ascending order of the candidates' indices, and over the points in the order of the curves: where
/// indices ascend with global ids, the result depends on nothing else, neither on the vectors' width.
class ForceSharing {
 public:
  /// Finds for every node the particles within `reach` (m) of `centres`, by node: the surface points, with reach = 2h
  /// plus what a point and a particle may move towards each other until the next rebuild; or the nodes' particles, with
  /// d/2 more. x, y: of all particles that may take part. All in m.
  void rebuild(std::span<const Vector> centres, std::span<const double> x, std::span<const double> y, double reach);

  /// Adds the accelerations (m/s2) to x and y components. points (m) and forces (N/m): by node; the other arrays by
  /// particle, as in rebuild; masses in kg/m. Returns the number of points with no particle within 2h, whose force is
  /// lost.
  std::size_t share(std::span<const Vector> points, std::span<const Vector> forces, std::span<const double> x,
                    std::span<const double> y, std::span<const double> masses, const SmoothingKernel& kernel,
                    std::span<double> acceleration_x, std::span<double> acceleration_y);

  /// All particles that are a candidate of some point, ascending.
  std::span<const std::int32_t> particles() const { return particles_; }

 private:
  void copy_candidates(std::span<const double> x, std::span<const double> y, std::span<const double> masses);
  template <class Kernel>
  void evaluate_kernel(std::span<const Vector> points, std::span<const Vector> forces, const Kernel& kernel);
  void sum_over_points();

  // Nodes go in slices, one node a lane of a vector; the candidates at the same place in their lists lie side by side.
  // Shorter lists are filled up with a particle so far away that its W is an exact zero.
  std::vector<std::int32_t> slice_start_;      ///< first entry of each slice, and their number
  std::vector<std::int32_t> candidate_count_;  ///< by node
  std::vector<std::int32_t> candidates_;       ///< indices into particles_
  std::vector<std::int32_t> particles_;

  // Scratch, by entry of candidates_, by node, and by entry of particles_.
  std::vector<double> weights_;
  std::vector<Vector> force_per_weight_;
  std::vector<double> candidate_x_ = {0.0}, candidate_y_ = {0.0};  // with the far-away one at the end
  std::vector<double> inverse_mass_;
  std::vector<Vector> shares_;
  std::size_t points_without_particles_ = 0;
};

}  // namespace sphdrop
