#pragma once
// Isotropic linear elasticity: moduli and wave speeds (Eq 5).

#include <cmath>

namespace sphdrop {

struct ElasticMaterial {
  double density = 0;         ///< rho0, kg/m3
  double youngs_modulus = 0;  ///< E, Pa
  double poisson_ratio = 0;   ///< nu

  constexpr double bulk_modulus() const { return youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)); }
  constexpr double shear_modulus() const { return youngs_modulus / (2.0 * (1.0 + poisson_ratio)); }
  /// c_s = sqrt(K/rho0), m/s.
  double sound_speed() const { return std::sqrt(bulk_modulus() / density); }
  /// sqrt((K + 4G/3)/rho0), m/s: the fastest wave, which limits the time step.
  double longitudinal_wave_speed() const { return std::sqrt((bulk_modulus() + 4.0 / 3.0 * shear_modulus()) / density); }
};

}  // namespace sphdrop
