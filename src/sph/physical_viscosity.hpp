#pragma once
// The viscosity of a Newtonian liquid (Monaghan & Cleary 1999), in the place of the artificial one.

namespace sphdrop {

/// Pi_ij = -8 mu/(rho_i rho_j) v_ij.x_ij/(r^2 + 0.01 h^2), on all pairs: -sum_j m_j Pi_ij grad W is mu/rho times the
/// Laplacian of the velocity in two dimensions. It acts along the line of centres, so that angular momentum is kept.
struct PhysicalViscosity {
  static constexpr bool takes_volumes = true;
  double viscosity = 0;         ///< mu, Pa s
  double smoothing_length = 0;  ///< h, m

  /// What the formula takes of the two densities: their product.
  template <class T>
  [[gnu::always_inline]] static T combined(const T& density_i, const T& density_j) {
    return density_i * density_j;
  }

  /// (r^2 + 0.01 h^2) rho_i rho_j, what Pi_ij is divided by: the caller inverts it together with other numbers.
  template <class T>
  [[gnu::always_inline]] T denominator(const T& squared_distance, const T& density_product) const {
    return (squared_distance + T(0.01 * smoothing_length * smoothing_length)) * density_product;
  }

  /// Pi_ij, m5/(kg s2). `inverse_denominator` is 1/denominator(). T is double or a SIMD vector.
  template <class T>
  [[gnu::always_inline]] T operator()(const T& velocity_dot_distance, const T& /*density_product*/,
                                      const T& inverse_denominator) const {
    return T(-8.0 * viscosity) * velocity_dot_distance * inverse_denominator;
  }
};

}  // namespace sphdrop
