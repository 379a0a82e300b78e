#pragma once
// Total-Lagrangian smoothed particle hydrodynamics of a solid: sums over the neighbours in the undeformed body
// (Vignjevic, Reveles & Campbell 2006; corrected gradients after Bonet & Lok 1999).

#include <algorithm>
#include <cmath>

#include "solid/plane_strain.hpp"
#include "sph/kernel.hpp"

namespace sphdrop {

/// The kernel's gradient at i by the distance X_i - X_j, over that distance's vector; an exact zero out of the support
/// and for j = i.
template <class T>
[[gnu::always_inline]] inline T gradient_factor(const CubicSpline& kernel, const T& x, const T& y) {
  using std::max;
  using std::sqrt;
  const T distance = sqrt(max(x * x + y * y, T(1e-60)));
  return kernel.slope(distance) / distance;
}

/// The first moment sum_j V_j (X_j - X_i) (x) grad W_ij, 1 in the bulk; symmetric.
template <class T>
[[gnu::always_inline]] inline void add_to_first_moment(const T& volume, const T& factor, const T& x, const T& y,
                                                       PlaneStrainTensor<T>& moment) {
  const T weight = volume * factor;
  moment.xx -= weight * x * x;
  moment.yy -= weight * y * y;
  moment.xy -= weight * x * y;
}

inline PlaneStrainTensor<double> inverse(const PlaneStrainTensor<double>& m) {
  const double scale = 1.0 / (m.xx * m.yy - m.xy * m.xy);
  return {scale * m.yy, scale * m.xx, -scale * m.xy};
}

/// sum_j V_j (u_j - u_i) (x) grad W_ij, of displacements or velocities: with `u` = u_i - u_j and `weight` = V_j
/// gradient_factor().
template <class T>
[[gnu::always_inline]] inline void add_to_gradient(const T& weight, const T& x, const T& y, const T& u_x, const T& u_y,
                                                   PlaneTensor<T>& gradient) {
  const T along_x = weight * x, along_y = weight * y;
  gradient.xx -= u_x * along_x;
  gradient.xy -= u_x * along_y;
  gradient.yx -= u_y * along_x;
  gradient.yy -= u_y * along_y;
}

/// The acceleration that j gives i, sum_j V_j/rho_0 (P_i B_i + P_j B_j) grad W_ij: the exact gradient of the energy sum
/// V psi(F), so that momentum, angular momentum and energy are kept. `load` = P B, Pa; `weight` = V_j/rho_0
/// gradient_factor().
template <class T>
[[gnu::always_inline]] inline void add_to_acceleration(const T& weight, const T& x, const T& y,
                                                       const PlaneTensor<T>& load_i, const PlaneTensor<T>& load_j,
                                                       T& acceleration_x, T& acceleration_y) {
  const T along_x = weight * x, along_y = weight * y;
  acceleration_x += (load_i.xx + load_j.xx) * along_x + (load_i.xy + load_j.xy) * along_y;
  acceleration_y += (load_i.yx + load_j.yx) * along_x + (load_i.yy + load_j.yy) * along_y;
}

}  // namespace sphdrop
