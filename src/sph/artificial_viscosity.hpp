#pragma once
// Monaghan's artificial viscosity (Eqs 17, 18).

#include <algorithm>

namespace sphdrop {

struct ArtificialViscosity {
  double alpha = 0;             ///< linear coefficient
  double beta = 0;              ///< quadratic coefficient
  double sound_speed = 0;       ///< c, m/s
  double smoothing_length = 0;  ///< h, m

  /// Pi_ij = (-alpha c mu + beta mu^2) / rho_mean with mu = h v_ij.x_ij / (r^2 + 0.01 h^2), on approaching pairs only;
  /// m5/(kg s2). T is double or a SIMD vector.
  template <class T>
  [[gnu::always_inline]] T operator()(const T& velocity_dot_distance, const T& squared_distance,
                                      const T& density_sum) const {
    using std::min;
    const T approaching = min(velocity_dot_distance, T(0.0));
    const T mu = T(smoothing_length) * approaching / (squared_distance + T(0.01 * smoothing_length * smoothing_length));
    return T(2.0) * (mu * (T(beta) * mu - T(alpha * sound_speed))) / density_sum;
  }
};

}  // namespace sphdrop
