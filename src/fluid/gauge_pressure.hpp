#pragma once
// A reference pressure that a drop's pressures are counted from.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace sphdrop {

/// Sums over a drop's pressures and their squares in whole numbers, which may be added in any order and over ranks with
/// the same result: a pressure is rounded to scale/2^31, and counts as +-scale beyond that.
class PressureSums {
 public:
  /// `scale`: larger than any sound pressure, rho0 c^2, Pa.
  explicit PressureSums(double scale) : unit_(scale * 0x1p-31) {}

  void add(double pressure) {
    constexpr double limit = 0x1p31 - 1;
    const double rounded = std::floor(pressure / unit_ + 0.5);
    const auto k = static_cast<std::int64_t>(std::min(std::max(-limit, rounded), limit));  // a NaN counts as -scale
    const auto square = static_cast<std::uint64_t>(k * k);
    words_[0] += k;
    words_[1] += static_cast<std::int64_t>(square & 0xffffffffU);
    words_[2] += static_cast<std::int64_t>(square >> 32U);
  }

  /// What adds up over ranks: for up to 2^30 particles in all.
  using Words = std::array<std::int64_t, 3>;
  const Words& words() const { return words_; }

  /// The pressure that particles need to be under so that all but a few stay above it: mean p - 3 std p, and never
  /// below `lowest`, Pa. `words` of `count` pressures.
  double target(std::span<const std::int64_t> words, double count, double lowest = 0) const {
    if (!(count > 0)) return 0;
    const double mean = static_cast<double>(words[0]) / count;
    const double mean_square = (static_cast<double>(words[2]) * 0x1p32 + static_cast<double>(words[1])) / count;
    const double variance = std::max(0.0, mean_square - mean * mean);
    return std::max(lowest, unit_ * (mean - 3.0 * std::sqrt(variance)));
  }

 private:
  double unit_;
  Words words_{};
};

/// A drop's gauge pressure p_ref. With it, the equation of state gives the pressure above p_ref, p_ref itself acts on
/// the drop's surface alone, and the particles' lattice, which is stiff under pressure, does not feel it. Below zero it
/// is the air's pressure with the sign turned: the surface is pressed in, and particles feel pressure where the liquid
/// is under tension, under which they would clump and leave voids.
struct GaugePressure {
  double pressure = 0;  ///< p_ref, Pa
  double target = 0;    ///< of the last instant, Pa

  /// dp = (target - p_ref) step / relaxation_time, which is added to p_ref and returned, Pa: each particle's density is
  /// to fall by dp/c^2, so that no pressure changes. Times in s.
  double relax(double step, double relaxation_time) {
    const double change = (target - pressure) * std::min(1.0, step / relaxation_time);
    pressure += change;
    return change;
  }
};

}  // namespace sphdrop
