#pragma once
// Sums of doubles whose result does not depend on the order of the terms or on who holds them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// A fixed-point accumulator wide enough for every finite double: terms are added without rounding, and value() rounds
/// once (to nearest). A NaN or infinity among the terms makes the value NaN; a sum beyond the largest double is
/// infinite, an intermediate sum beyond it does no harm. An exact zero is +0.
class ExactSum {
 public:
  void add(double term);
  void add(const ExactSum& other);
  /// Collective: makes every sum the sum over all ranks (at most 2^20), in one reduction.
  static void reduce(std::span<ExactSum> sums, const Communicator& communicator);
  double value() const;

 private:
  friend class PendingExactSums;
  /// Passes carries on: afterwards every limb but the last is in [0, 2^32), and the last one carries the sign.
  void normalise();
  /// The sums as whole numbers that may be added over ranks, and back.
  static void write(std::span<ExactSum> sums, std::vector<std::int64_t>& words);
  static void read(std::span<const std::int64_t> words, std::span<ExactSum> sums);

  // Limb k counts units of 2^(32 k - 1074). 66 limbs reach DBL_MAX, two more leave room for 2^63 such terms.
  static constexpr std::size_t limb_count = 68;
  std::array<std::int64_t, limb_count> limbs_{};
  std::int64_t carries_ = 0;     ///< every limb is less than (carries_ + 1) 2^33 in magnitude
  std::int64_t not_finite_ = 0;  ///< terms that were NaN or infinite
};

/// Exact sums over all ranks that are under way while the caller computes. One at a time (asserted). The communicator
/// must outlive it.
class PendingExactSums {
 public:
  explicit PendingExactSums(const Communicator& communicator) : handle_(communicator.handle()) {}
  ~PendingExactSums();
  PendingExactSums(const PendingExactSums&) = delete;
  PendingExactSums& operator=(const PendingExactSums&) = delete;

  bool is_under_way() const { return request_ != MPI_REQUEST_NULL; }
  /// Collective. Posts the reduction of `sums`, as many as on every other rank (at most 2^20 ranks).
  void start(std::span<ExactSum> sums);
  /// Waits for it, and makes `sums`, as many as were given, the sums over all ranks.
  void finish(std::span<ExactSum> sums);

 private:
  MPI_Comm handle_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  std::vector<std::int64_t> mine_, all_;
};

}  // namespace sphdrop
