#pragma once
// The hypoelastic stress rate (Eqs 6-8).

namespace sphdrop {

/// A symmetric tensor of the plane. T is double or a SIMD vector.
template <class T>
struct SymmetricTensor {
  T xx{0.0}, yy{0.0}, xy{0.0};
};

/// grad v: xy is dv_x/dy, 1/s.
template <class T>
struct VelocityGradient {
  T xx{0.0}, xy{0.0}, yx{0.0}, yy{0.0};
};

/// dtau/dt = 2G (e - k tr(e) I) + r.tau - tau.r, Pa/s, with strain rate e (7) and rotation rate r (8), the symmetric
/// and the antisymmetric part of grad v (6). k = trace_factor: 1/3 for plane strain, 1/2 for a tensor traceless in two
/// dimensions.
template <class T>
[[gnu::always_inline]] inline SymmetricTensor<T> jaumann_stress_rate(const VelocityGradient<T>& gradient,
                                                                     const SymmetricTensor<T>& deviatoric_stress,
                                                                     double shear_modulus, double trace_factor) {
  const T two_g(2.0 * shear_modulus);
  const T spherical = T(trace_factor) * (gradient.xx + gradient.yy);
  const T rotation_xy = T(0.5) * (gradient.xy - gradient.yx);
  const T turning = T(2.0) * rotation_xy * deviatoric_stress.xy;
  return {two_g * (gradient.xx - spherical) + turning, two_g * (gradient.yy - spherical) - turning,
          two_g * (T(0.5) * (gradient.xy + gradient.yx)) + rotation_xy * (deviatoric_stress.yy - deviatoric_stress.xx)};
}

}  // namespace sphdrop
