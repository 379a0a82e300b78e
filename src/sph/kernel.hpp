#pragma once
// Smoothing kernels in two dimensions: the cubic spline (Eq 11), and Wendland's C2 function.

#include <algorithm>
#include <numbers>
#include <variant>

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
    // 4 is a power of two: it may stand anywhere, and here slope() has computed 4 b b, too.
    return T(value_factor) * (a * a * a - T(4.0) * (b * b) * b);
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

/// Wendland's C2 function (1995) with the support 2h of the spline: W(q) = a (1 - q/2)^4 (2 q + 1) for q < 2, 0 beyond;
/// a = 7/(4 pi h^2). Its Fourier transform is positive, so that particles do not pair under pressure. Without branches,
/// as the spline.
struct WendlandC2 {
  double inverse_smoothing_length;  ///< 1/h, 1/m
  double value_factor;              ///< a, 1/m2
  double slope_factor;              ///< -5 a/h, 1/m3

  explicit constexpr WendlandC2(double smoothing_length)
      : inverse_smoothing_length(1.0 / smoothing_length),
        value_factor(7.0 / (4.0 * std::numbers::pi * smoothing_length * smoothing_length)),
        slope_factor(-5.0 * value_factor / smoothing_length) {}

  /// W at distance r, 1/m2. T is double or a SIMD vector.
  template <class T>
  [[gnu::always_inline]] T value(const T& r) const {
    using std::max;
    const T q = r * T(inverse_smoothing_length);
    const T a = max(T(1.0) - T(0.5) * q, T(0.0));
    const T square = a * a;
    return T(value_factor) * (square * square) * (T(2.0) * q + T(1.0));
  }

  /// dW/dr at distance r, 1/m3: never positive.
  template <class T>
  [[gnu::always_inline]] T slope(const T& r) const {
    using std::max;
    const T q = r * T(inverse_smoothing_length);
    const T a = max(T(1.0) - T(0.5) * q, T(0.0));
    return T(slope_factor) * (q * (a * a * a));
  }
};

/// The kernel that a case has chosen. Which one it holds is asked outside the loops over particles (std::visit).
using SmoothingKernel = std::variant<CubicSpline, WendlandC2>;

/// W at distance r, 1/m2, of whichever kernel it is: for single values.
inline double kernel_value(const SmoothingKernel& kernel, double r) {
  return std::visit([r](const auto& k) { return k.value(r); }, kernel);
}

}  // namespace sphdrop
