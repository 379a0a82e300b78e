#pragma once
// Monaghan's artificial viscosity (Eqs 17, 18).

#include <algorithm>

namespace sphdrop {

struct ArtificialViscosity {
  static constexpr bool takes_volumes = false;
  double alpha = 0;             ///< linear coefficient
  double beta = 0;              ///< quadratic coefficient
  double sound_speed = 0;       ///< c, m/s
  double smoothing_length = 0;  ///< h, m

  /// What the formula takes of the two densities: their sum.
  template <class T>
  [[gnu::always_inline]] static T combined(const T& density_i, const T& density_j) {
    return density_i + density_j;
  }

  /// (r^2 + 0.01 h^2)(rho_i + rho_j), what Pi_ij is divided by: the caller inverts it together with other numbers.
  template <class T>
  [[gnu::always_inline]] T denominator(const T& squared_distance, const T& density_sum) const {
    return (squared_distance + T(0.01 * smoothing_length * smoothing_length)) * density_sum;
  }

  /// Pi_ij = (-alpha c mu + beta mu^2) / rho_mean with mu = h v_ij.x_ij / (r^2 + 0.01 h^2), on approaching pairs only;
  /// m5/(kg s2). `inverse_denominator` is 1/denominator(). T is double or a SIMD vector.
  template <class T>
  [[gnu::always_inline]] T operator()(const T& velocity_dot_distance, const T& density_sum,
                                      const T& inverse_denominator) const {
    using std::min;
    const T mu_over_density_sum = T(smoothing_length) * min(velocity_dot_distance, T(0.0)) * inverse_denominator;
    return T(2.0) * mu_over_density_sum * (T(beta) * (mu_over_density_sum * density_sum) - T(alpha * sound_speed));
  }
};

/// The same with beta = 0, which most cases have: the quadratic term would add an exact zero.
struct LinearArtificialViscosity : ArtificialViscosity {
  explicit LinearArtificialViscosity(const ArtificialViscosity& general) : ArtificialViscosity(general) {}

  template <class T>
  [[gnu::always_inline]] T operator()(const T& velocity_dot_distance, const T& /*density_sum*/,
                                      const T& inverse_denominator) const {
    using std::min;
    return T(smoothing_length) * min(velocity_dot_distance, T(0.0)) * inverse_denominator *
           T(-2.0 * (alpha * sound_speed));
  }
};

/// 1/a and 1/b by one division: dividing costs as much as ten multiplications. The product a b must be in range.
template <class T>
struct InversePair {
  T first, second;

  [[gnu::always_inline]] static T of_product(const T& a, const T& b) { return T(1.0) / (a * b); }

  [[gnu::always_inline]] InversePair(const T& a, const T& b, const T& inverse_product)
      : first(inverse_product * b), second(inverse_product * a) {}
  [[gnu::always_inline]] InversePair(const T& a, const T& b) : InversePair(a, b, of_product(a, b)) {}
};

}  // namespace sphdrop
