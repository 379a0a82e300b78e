#pragma once
// Quick sums of doubles whose result does not depend on the order of the terms or on who holds them.

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

namespace sphdrop {

/// Every term is rounded to a multiple of a quantum; such numbers are added without rounding. An ExactSum keeps all
/// digits, this takes a few instructions a term.
class QuantisedSum {
 public:
  /// Rounds to the largest power of two that is not above `quantum`, which must be a normal number greater than zero
  /// (asserted).
  explicit QuantisedSum(double quantum)
      : quantum_(std::ldexp(1.0, std::ilogb(quantum))), to_integer_(0x1.8p52 * quantum_) {
    assert(std::isnormal(quantum) && quantum > 0.0);
  }

  /// A term must be less than 2^51 quanta, and so must every sum; what is beyond loses its last digits.
  void add(double term) { sum_ += rounded(term); }
  void add(std::span<const double> terms) {
    // Several sums side by side, so that none waits for another; the two loops are two steps of vectors.
    constexpr std::size_t width = 8;
    std::array<double, width> sums{}, multiples;
    std::size_t k = 0;
    for (; k + width <= terms.size(); k += width) {
      for (std::size_t lane = 0; lane < width; ++lane) multiples[lane] = rounded(terms[k + lane]);
      for (std::size_t lane = 0; lane < width; ++lane) sums[lane] += multiples[lane];
    }
    for (; k < terms.size(); ++k) sum_ += rounded(terms[k]);
    for (const double sum : sums) sum_ += sum;
  }
  void add(const QuantisedSum& other) { sum_ += other.sum_; }

  double value() const { return sum_; }
  double quantum() const { return quantum_; }
  /// How many quanta it is.
  std::int64_t quanta() const { return std::llround(sum_ / quantum_); }

 private:
  // A number that has no digits below a quantum: adding it rounds them away.
  double rounded(double term) const { return (term + to_integer_) - to_integer_; }

  double quantum_, to_integer_, sum_ = 0.0;
};

}  // namespace sphdrop
