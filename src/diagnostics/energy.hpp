#pragma once
// A particle's share of the energy ledger. Its sums are written to history.csv, whose bytes must be the same on every
// machine, so nothing here calls a transcendental function of the C library.

#include "particles/vector.hpp"

namespace sphdrop {

/// m v^2 / 2, J/m; mass in kg/m.
constexpr double kinetic_energy(double mass, Vector velocity) {
  return 0.5 * mass * squared_length(velocity);
}

/// Energy stored by compressing the material from density rho0 to rho under p = c^2 (rho - rho0) (Eqs 4, 5), J/kg: the
/// integral of p/rho^2, c^2 [ln(rho/rho0) + rho0/rho - 1]. Never negative; c^2 x^2/2 for a small strain x = rho/rho0
/// - 1. Accurate to rounding for 1/20 <= rho/rho0 <= 20; densities in kg/m3, sound speed in m/s.
constexpr double compressive_energy_per_mass(double density, double reference_density, double sound_speed) {
  // With z = (rho - rho0)/(rho + rho0) the logarithm is 2 (z + z^3/3 + z^5/5 + ...), and the linear terms, which would
  // cancel all digits near rho0, drop out of the sum by hand: 2 z^2/(1 + z) + 2 z^3 (1/3 + z^2/5 + z^4/7 + ...).
  const double z = (density - reference_density) / (density + reference_density);
  const double z_squared = z * z;
  double power = 1, tail = 0;
  // Ends by itself once a term is lost in rounding; the bound is for a density that is not a number.
  for (int n = 3; n < 500; n += 2) {
    const double next = tail + power / n;
    if (next == tail) break;
    tail = next;
    power *= z_squared;
  }
  return sound_speed * sound_speed * (2.0 * z_squared / (1.0 + z) + 2.0 * z * z_squared * tail);
}

/// Deviatoric stress tau, Pa, with the component out of the plane that the model implies.
struct DeviatoricStress {
  double xx = 0, yy = 0, xy = 0;
  double zz = 0;
};

/// Plane strain, k = 1/3 in Eq 6: the deviator is traceless in three dimensions, tau_zz = -(tau_xx + tau_yy).
constexpr DeviatoricStress plane_strain_deviator(double xx, double yy, double xy) {
  return {xx, yy, xy, -(xx + yy)};
}

/// The two-dimensional model, k = 1/2 in Eq 6: the deviator is traceless within the plane and has no zz component.
constexpr DeviatoricStress two_dimensional_deviator(double xx, double yy, double xy) {
  return {xx, yy, xy, 0.0};
}

/// tau:tau / (4 G), J/m3: the energy of distortion. Shear modulus G in Pa.
constexpr double distortion_energy_density(const DeviatoricStress& tau, double shear_modulus) {
  const double contraction = tau.xx * tau.xx + tau.yy * tau.yy + tau.zz * tau.zz + 2.0 * (tau.xy * tau.xy);
  return contraction / (4.0 * shear_modulus);
}

/// tau:tau/(4 G) + p^2/(2 K), J/m3: the energy an isotropic linear elastic material would give back on unloading from
/// tau and p. Assumes small strains: a hypoelastic solid has no exact stored energy, and after large strains or
/// rotations in a cycle this is the energy of its present stress only. p^2/(2 K) is the small-strain limit of rho
/// compressive_energy_per_mass with K = rho0 c_s^2; use that one with distortion_energy_density where the equation of
/// state's own energy is wanted. Moduli in Pa; multiply by m/rho for a particle.
constexpr double elastic_energy_density(const DeviatoricStress& tau, double pressure, double shear_modulus,
                                        double bulk_modulus) {
  return distortion_energy_density(tau, shear_modulus) + pressure * pressure / (2.0 * bulk_modulus);
}

}  // namespace sphdrop
