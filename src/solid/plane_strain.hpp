#pragma once
// Elastic laws in plane strain: stored energy and first Piola-Kirchhoff stress of a deformation gradient.

#include "particles/elementary_functions.hpp"
#include "solid/elasticity.hpp"

namespace sphdrop {

/// A tensor of the plane; of a deformation gradient F, xy is dx/dY. T is double or a SIMD vector.
template <class T>
struct PlaneTensor {
  T xx{0.0}, xy{0.0}, yx{0.0}, yy{0.0};
};

/// J = det F, the area of the deformed body over that of the undeformed one.
template <class T>
[[gnu::always_inline]] inline T determinant(const PlaneTensor<T>& f) {
  return f.xx * f.yy - f.xy * f.yx;
}

/// A symmetric tensor of the plane, as Green's strain.
template <class T>
struct PlaneStrainTensor {
  T xx{0.0}, yy{0.0}, xy{0.0};
};

/// F S.
template <class T>
[[gnu::always_inline]] inline PlaneTensor<T> product(const PlaneTensor<T>& f, const PlaneStrainTensor<T>& s) {
  return {f.xx * s.xx + f.xy * s.xy, f.xx * s.xy + f.xy * s.yy, f.yx * s.xx + f.yy * s.xy, f.yx * s.xy + f.yy * s.yy};
}

/// Green's strain, (F^T F - I)/2.
template <class T>
[[gnu::always_inline]] inline PlaneStrainTensor<T> green_strain(const PlaneTensor<T>& f) {
  return {T(0.5) * (f.xx * f.xx + f.yx * f.yx - T(1.0)), T(0.5) * (f.xy * f.xy + f.yy * f.yy - T(1.0)),
          T(0.5) * (f.xx * f.xy + f.yx * f.yy)};
}

/// Its rate, the symmetric part of F^T dF/dt.
template <class T>
[[gnu::always_inline]] inline PlaneStrainTensor<T> green_strain_rate(const PlaneTensor<T>& f,
                                                                     const PlaneTensor<T>& rate) {
  return {f.xx * rate.xx + f.yx * rate.yx, f.xy * rate.xy + f.yy * rate.yy,
          T(0.5) * (f.xx * rate.xy + f.yx * rate.yy + f.xy * rate.xx + f.yy * rate.yx)};
}

/// Lame's moduli, Pa, and what follows from them.
struct LameModuli {
  double lambda = 0, mu = 0;

  LameModuli() = default;
  explicit LameModuli(const ElasticMaterial& material)
      : lambda(material.bulk_modulus() - 2.0 / 3.0 * material.shear_modulus()), mu(material.shear_modulus()) {}

  /// Hooke's law, lambda tr(e) I + 2 mu e.
  template <class T>
  [[gnu::always_inline]] PlaneStrainTensor<T> stress(const PlaneStrainTensor<T>& strain) const {
    const T spherical = T(lambda) * (strain.xx + strain.yy);
    const T two_mu(2.0 * mu);
    return {spherical + two_mu * strain.xx, spherical + two_mu * strain.yy, two_mu * strain.xy};
  }
  /// lambda/2 tr(e)^2 + mu e:e.
  template <class T>
  [[gnu::always_inline]] T energy(const PlaneStrainTensor<T>& e) const {
    const T trace = e.xx + e.yy;
    return T(0.5 * lambda) * trace * trace + T(mu) * (e.xx * e.xx + e.yy * e.yy + T(2.0) * (e.xy * e.xy));
  }
};

/// Saint Venant and Kirchhoff: Hooke's law between Green's strain and the second Piola-Kirchhoff stress (Bonet & Wood
/// 2008, 6.4.1). Under strong compression it gives way; use it for small strains and any rotation.
struct StVenantKirchhoff {
  LameModuli moduli;

  template <class T>
  [[gnu::always_inline]] PlaneTensor<T> stress(const PlaneTensor<T>& f) const {
    return product(f, moduli.stress(green_strain(f)));
  }
  double energy_density(const PlaneTensor<double>& f) const { return moduli.energy(green_strain(f)); }
  /// First Piola-Kirchhoff stress out of the plane, where nothing is strained.
  double stress_out_of_plane(const PlaneTensor<double>& f) const {
    const auto strain = green_strain(f);
    return moduli.lambda * (strain.xx + strain.yy);
  }
};

/// Neo-Hookean: mu/2 (tr F^T F - 2) + lambda/4 (J^2 - 1) - (lambda/2 + mu) ln J (Simo & Hughes 1998, 9.2.3): no finite
/// energy squeezes it to nothing, and its stress has no logarithm.
struct NeoHookean {
  LameModuli moduli;

  template <class T>
  [[gnu::always_inline]] PlaneTensor<T> stress(const PlaneTensor<T>& f) const {
    const T j = determinant(f);
    const T inverse = T(1.0) / j;
    const T mu(moduli.mu);
    // d J/dF is the cofactor matrix ((F_yy, -F_yx), (-F_xy, F_xx)).
    const T along = T(0.5 * moduli.lambda) * (j - inverse) - mu * inverse;
    return {mu * f.xx + along * f.yy, mu * f.xy - along * f.yx, mu * f.yx - along * f.xy, mu * f.yy + along * f.xx};
  }
  double energy_density(const PlaneTensor<double>& f) const {
    const double j = determinant(f);
    const double invariant = f.xx * f.xx + f.xy * f.xy + f.yx * f.yx + f.yy * f.yy;
    return 0.5 * moduli.mu * (invariant - 2.0) + 0.25 * moduli.lambda * (j * j - 1.0) -
           (0.5 * moduli.lambda + moduli.mu) * natural_logarithm(j);
  }
  double stress_out_of_plane(const PlaneTensor<double>& f) const {
    const double j = determinant(f);
    return 0.5 * moduli.lambda * (j * j - 1.0);
  }
};

/// Cauchy's stress sigma = P F^T/J, Pa, with the component out of the plane.
struct CauchyStress {
  double xx = 0, yy = 0, xy = 0, zz = 0;

  double pressure() const { return -(xx + yy + zz) / 3.0; }
};

template <class Law>
CauchyStress cauchy_stress(const Law& law, const PlaneTensor<double>& f) {
  const PlaneTensor<double> p = law.stress(f);
  const double inverse = 1.0 / determinant(f);
  return {inverse * (p.xx * f.xx + p.xy * f.xy), inverse * (p.yx * f.yx + p.yy * f.yy),
          inverse * (p.xx * f.yx + p.xy * f.yy), inverse * law.stress_out_of_plane(f)};
}

}  // namespace sphdrop
