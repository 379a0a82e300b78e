#pragma once
// Sums of doubles whose result does not depend on the order of the terms or on who holds them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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
  /// Passes carries on: afterwards every limb but the last is in [0, 2^32), and the last one carries the sign.
  void normalise();

  // Limb k counts units of 2^(32 k - 1074). 66 limbs reach DBL_MAX, two more leave room for 2^63 such terms.
  static constexpr std::size_t limb_count = 68;
  std::array<std::int64_t, limb_count> limbs_{};
  std::int64_t carries_ = 0;     ///< every limb is less than (carries_ + 1) 2^33 in magnitude
  std::int64_t not_finite_ = 0;  ///< terms that were NaN or infinite
};

}  // namespace sphdrop
