#pragma once
// Gray, Monaghan & Swift's artificial stress against the tensile instability (Eqs 19-23).

#include <algorithm>
#include <cmath>

#include "solid/hypoelastic/jaumann_rate.hpp"

namespace sphdrop {

/// R of a particle: along each principal direction of sigma with a principal stress s > 0, -coefficient s / rho^2, zero
/// otherwise, turned back to x and y (20-23). The angle of Eq 21 enters through its double alone, whose sine and cosine
/// are sigma_xy and (sigma_xx - sigma_yy)/2 over the radius of Mohr's circle: no trigonometry. T is double or a SIMD
/// vector.
template <class T>
[[gnu::always_inline]] inline SymmetricTensor<T> artificial_stress(const SymmetricTensor<T>& stress, const T& density,
                                                                   double coefficient) {
  using std::max;
  using std::sqrt;
  const T mean = T(0.5) * (stress.xx + stress.yy);
  const T half_difference = T(0.5) * (stress.xx - stress.yy);
  const T radius = sqrt(half_difference * half_difference + stress.xy * stress.xy);
  const T factor = T(-coefficient) / (density * density);
  const T first = factor * max(mean + radius, T(0.0));
  const T second = factor * max(mean - radius, T(0.0));
  const T centre = T(0.5) * (first + second);
  const T deviation = T(0.5) * (first - second) / max(radius, T(1e-200));  // of R's own circle, over sigma's radius
  return {centre + deviation * half_difference, centre - deviation * half_difference, deviation * stress.xy};
}

}  // namespace sphdrop
