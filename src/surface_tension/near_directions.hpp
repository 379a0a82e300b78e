#pragma once
// A cheap test that sorts out the particles inside the liquid.

#include <algorithm>
#include <experimental/simd>

namespace sphdrop {

/// Whether there are near neighbours in all directions about a particle. Then their circles cover the whole of its own,
/// whatever other neighbours it has, and it has no arcs; otherwise nothing is said. T is double, or a SIMD vector with
/// a particle in each lane.
///
/// A neighbour that is near covers more than an octant and a half of the circle to either side: 67.5 degrees. If each
/// of eight quadrants, turned by an octant from one to the next, holds such a neighbour, no gap between two of them is
/// as wide as three octants, as it would hold a whole quadrant.
template <class T>
class NearDirections {
 public:
  /// radius: R = 2h, m. A neighbour at distance r covers acos(r / 2R) to either side.
  explicit NearDirections(double radius) : squared_reach_(squared_reach(radius)) {}
  /// Of neighbours that count: r < 2R cos 67.5, m2.
  static double squared_reach(double radius) { return 0.58 * radius * radius; }

  /// (x, y): from the particle to a neighbour, m; where it is zero, as for the particle itself, it does not count.
  [[gnu::always_inline]] void add(const T& x, const T& y) {
    using std::max;
    // Zero if it is far; only signs matter. A mask would do, but clang 14 miscompiles those of std::experimental::simd
    // for AVX-512.
    const T near = max(squared_reach_ - (x * x + y * y), T(0.0));
    upright_.add(near * x, near * y);
    oblique_.add(near * (x + y), near * (y - x));
  }
  /// Positive where they cover the circle.
  T cover() const {
    using std::min;
    return min(upright_.least_held(), oblique_.least_held());
  }

 private:
  /// The four quadrants about two axes. A coordinate that is zero is in none.
  struct Quadrants {
    T first = 0.0, second = 0.0, third = 0.0, fourth = 0.0;

    [[gnu::always_inline]] void add(const T& x, const T& y) {
      using std::max;
      using std::min;
      const T down = -y;
      first = max(first, min(x, y));
      second = min(second, max(x, down));
      third = min(third, max(x, y));
      fourth = max(fourth, min(x, down));
    }
    /// Positive where each of them holds one.
    T least_held() const {
      using std::min;
      const T minus_second = -second, minus_third = -third;
      return min(min(first, minus_second), min(minus_third, fourth));
    }
  };

  T squared_reach_;
  Quadrants upright_, oblique_;
};

}  // namespace sphdrop
