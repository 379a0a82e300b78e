#pragma once
// Repeatable random numbers for tests.

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop::test {

/// The same numbers for the same seed with every standard library.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vector in_box(Vector low, Vector high) {
    const double x = between(low.x, high.x);
    return {x, between(low.y, high.y)};
  }
  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t k = values.size(); k > 1; --k) std::swap(values[k - 1], values[engine_() % k]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sphdrop::test
