#pragma once
// The cubic spline (Eq 11) in two dimensions.

#include <algorithm>
#include <numbers>

namespace sphdrop {

/// W(q) = a (2/3 - q^2 + q^3/2) for q < 1, a (2 - q)^3 / 6 for 1 <= q < 2, 0 beyond; q = r/h, a = 15/(7 pi h^2) (Eq
/// 11). Written without branches, so that a lane of a vector outside the support contributes an exact zero.
struct CubicSpline {
  double inverse_smoothing_length;  ///< 1/h, 1/m
  double value_factor;              ///< a/6, 1/m2
  double slope_factor;              ///< -a/(2h), 1/m3

  explicit constexpr CubicSpline(double smoothing_length)
      : inverse_smoothing_length(1.0 / smoothing_length),
        value_factor(15.0 / (7.0 * std::numbers::pi * smoothing_length * smoothing_length) / 6.0),
        slope_factor(-3.0 * value_factor / smoothing_length) {}

  /// W at distance r, 1/m2. T is double or a SIMD vector.
  template <class T>
  [[gnu::always_inline]] T value(const T& r) const {
    using std::max;
    const T q = r * T(inverse_smoothing_length);
    const T a = max(T(2.0) - q, T(0.0));
    const T b = max(T(1.0) - q, T(0.0));
    return T(value_factor) * (a * a * a - T(4.0) * (b * b * b));
  }

  /// dW/dr at distance r, 1/m3: never positive.
  template <class T>
  [[gnu::always_inline]] T slope(const T& r) const {
    using std::max;
    const T q = r * T(inverse_smoothing_length);
    const T a = max(T(2.0) - q, T(0.0));
    const T b = max(T(1.0) - q, T(0.0));
    return T(slope_factor) * (a * a - T(4.0) * (b * b));
  }
};

}  // namespace sphdrop
