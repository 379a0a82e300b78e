#pragma once
// A cheap test that sorts out the particles inside the liquid.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

namespace sphdrop {

/// Integers of the size of doubles, as many as T has.
template <class T>
struct BitsOf {
  using Type = std::experimental::rebind_simd_t<std::uint64_t, T>;
};
template <>
struct BitsOf<double> {
  using Type = std::uint64_t;
};

/// Whether there are near neighbours in all directions about a particle. Then their circles cover the whole of its own,
/// whatever other neighbours it has, and it has no arcs; otherwise nothing is said. T is double, or a SIMD vector with
/// a particle in each lane.
///
/// A neighbour that is near covers more than an octant and a half of the circle to either side: 67.5 degrees. If of two
/// octants side by side at least one holds such a neighbour, no gap between two of them is wider than three octants:
/// two would lie in it. A neighbour between two octants counts for one of them.
template <class T>
class NearDirections {
 public:
  /// radius: R = 2h, m. A neighbour at distance r covers acos(r / 2R) to either side.
  explicit NearDirections(double radius) : squared_reach_(squared_reach(radius)) {}
  /// Of neighbours that count: r < 2R cos 67.5, m2.
  static double squared_reach(double radius) { return 0.58 * radius * radius; }

  /// (x, y): from the particle to a neighbour, m; where it is zero, as for the particle itself, it does not count.
  [[gnu::always_inline]] void add(const T& x, const T& y) {
    // By signs, which are bits: a comparison would make a mask, and clang 14 miscompiles those of
    // std::experimental::simd for AVX-512.
    const T squared = x * x + y * y;
    const Bits is_near = (sign_and_more(squared - squared_reach_) & sign_and_more(T(0.0) - squared)) >> 63;
    const Bits x_bits = sign_and_more(x), y_bits = sign_and_more(y);
    const Bits is_steep = sign_and_more(magnitude(x_bits) - magnitude(y_bits));
    const Bits octant = (is_steep >> 63) | ((x_bits >> 62) & Bits(2)) | ((y_bits >> 61) & Bits(4));
    held_ |= is_near << octant;
  }
  /// Whether they cover the circle; of one lane.
  bool cover(std::size_t lane = 0) const {
    if constexpr (std::is_same_v<T, double>)
      return covered()[held_];
    else
      return covered()[held_[lane]];
  }

 private:
  using Bits = typename BitsOf<T>::Type;

  [[gnu::always_inline]] static Bits sign_and_more(const T& value) { return std::bit_cast<Bits>(value); }
  [[gnu::always_inline]] static T magnitude(const Bits& bits) {
    return std::bit_cast<T>(bits & Bits(~(std::uint64_t{1} << 63)));
  }
  /// By the octants that hold one, a bit each.
  static const std::array<bool, 256>& covered() {
    static constexpr std::array<bool, 256> table = [] {
      // Counterclockwise from the axis of x, as add() numbers them.
      constexpr std::array<int, 8> round{0, 1, 3, 2, 6, 7, 5, 4};
      std::array<bool, 256> result{};
      for (int held = 0; held < 256; ++held) {
        bool all = true;
        for (std::size_t k = 0; k < 8; ++k)
          all = all && ((held >> round[k] & 1) != 0 || (held >> round[(k + 1) % 8] & 1) != 0);
        result[static_cast<std::size_t>(held)] = all;
      }
      return result;
    }();
    return table;
  }

  T squared_reach_;
  Bits held_ = 0;  ///< octants
};

}  // namespace sphdrop
