#pragma once
// How far two particles are apart, and what is divided by that: the slow steps of every pair, on their own. A core
// looks only so far ahead; where the steps of several pairs are written side by side it need not wait for roots and
// divisions.

#include <algorithm>
#include <cmath>

#include "sph/artificial_viscosity.hpp"

namespace sphdrop {

/// The first step, which ends with a square root. T is double or a SIMD vector.
template <class T>
struct Separation {
  T x, y, squared_distance, distance;

  Separation() = default;
  /// Of x_i - x_j.
  [[gnu::always_inline]] Separation(const T& along_x, const T& along_y)
      : x(along_x), y(along_y), squared_distance(x * x + y * y) {
    using std::max;
    using std::sqrt;
    distance = sqrt(max(squared_distance, T(1e-60)));
  }
};

/// The second step, a division that serves the gradient and the viscosity.
template <class T>
struct InverseSeparation : Separation<T> {
  T densities, denominator, inverse_product;

  InverseSeparation() = default;
  template <class Viscosity>
  [[gnu::always_inline]] InverseSeparation(const Separation<T>& separation, const Viscosity& viscosity,
                                           const T& density_i, const T& density_j)
      : Separation<T>(separation),
        densities(Viscosity::combined(density_i, density_j)),
        denominator(viscosity.denominator(separation.squared_distance, densities)),
        inverse_product(InversePair<T>::of_product(separation.distance, denominator)) {}

  /// 1/distance and 1/denominator.
  [[gnu::always_inline]] InversePair<T> inverse() const {
    return InversePair<T>(this->distance, denominator, inverse_product);
  }
};

}  // namespace sphdrop
