#pragma once
// What one solid particle contributes to the rates of another (Eqs 7-9, 14-19).

#include <algorithm>
#include <cmath>

#include "solid/hypoelastic/jaumann_rate.hpp"
#include "sph/artificial_viscosity.hpp"
#include "sph/kernel.hpp"

namespace sphdrop {

/// The quantities of a solid particle that enter the pair formula. T is double or a SIMD vector.
template <class T>
struct HypoelasticState {
  T x, y, velocity_x, velocity_y, density, mass, volume;
  SymmetricTensor<T> stress, artificial_stress;
};

/// Sums over the neighbours of a particle.
template <class T>
struct HypoelasticRates {
  T density_rate{0.0};    ///< drho/dt (9), kg/(m3 s)
  T acceleration_x{0.0};  ///< by stress and viscosity (14), m/s2
  T acceleration_y{0.0};
  T artificial_x{0.0};  ///< by the artificial stress (14, 19), m/s2
  T artificial_y{0.0};
  T dissipation_rate{0.0};       ///< specific heating by Pi, W/kg
  VelocityGradient<T> gradient;  ///< (15, 16), 1/s
};

struct HypoelasticPairParameters {
  CubicSpline kernel;
  ArtificialViscosity viscosity;
  double inverse_kernel_at_spacing = 0;  ///< 1/W(d) of Eq 19, m2
};

/// Adds what j contributes to i. Out of the kernel's support, and for j = i, that is an exact zero.
template <class T>
[[gnu::always_inline]] inline void add_hypoelastic_pair(const HypoelasticPairParameters& parameters,
                                                        const HypoelasticState<T>& i, const T& inverse_density_i,
                                                        const HypoelasticState<T>& j, HypoelasticRates<T>& rates) {
  using std::max;
  using std::sqrt;
  const T x = i.x - j.x, y = i.y - j.y;
  const T velocity_x = i.velocity_x - j.velocity_x, velocity_y = i.velocity_y - j.velocity_y;
  const T squared_distance = x * x + y * y;
  const T distance = sqrt(max(squared_distance, T(1e-60)));
  const T density_sum = i.density + j.density;
  const InversePair<T> inverse(distance, parameters.viscosity.denominator(squared_distance, density_sum));
  const T slope = parameters.kernel.slope(distance) * inverse.first;  // grad W = slope x_ij
  const T gradient_x = slope * x, gradient_y = slope * y;
  const T velocity_dot_distance = velocity_x * x + velocity_y * y;
  const T velocity_dot_gradient = velocity_dot_distance * slope;

  rates.density_rate += j.mass * velocity_dot_gradient;  // (9)

  // (15, 16): dv^a/dx^b = sum V_j (v_j - v_i)^a grad^b W
  const T weighted_x = j.volume * gradient_x, weighted_y = j.volume * gradient_y;
  rates.gradient.xx -= velocity_x * weighted_x;
  rates.gradient.xy -= velocity_x * weighted_y;
  rates.gradient.yx -= velocity_y * weighted_x;
  rates.gradient.yy -= velocity_y * weighted_y;

  // (14): m_j (sigma_i + sigma_j)/(rho_i rho_j) = V_j (sigma_i + sigma_j)/rho_i
  const T viscous = j.mass * parameters.viscosity(velocity_dot_distance, density_sum, inverse.second);
  const T elastic = j.volume * inverse_density_i;
  const T xx = elastic * (i.stress.xx + j.stress.xx) - viscous;
  const T yy = elastic * (i.stress.yy + j.stress.yy) - viscous;
  const T xy = elastic * (i.stress.xy + j.stress.xy);
  rates.acceleration_x += xx * gradient_x + xy * gradient_y;
  rates.acceleration_y += xy * gradient_x + yy * gradient_y;
  rates.dissipation_rate += T(0.5) * viscous * velocity_dot_gradient;

  // (19): (R_i + R_j) f^4, f = W(r)/W(d)
  const T f = parameters.kernel.value(distance) * T(parameters.inverse_kernel_at_spacing);
  const T squared_f = f * f;
  const T weight = j.mass * (squared_f * squared_f);
  const T artificial_xy = i.artificial_stress.xy + j.artificial_stress.xy;
  rates.artificial_x +=
      weight * ((i.artificial_stress.xx + j.artificial_stress.xx) * gradient_x + artificial_xy * gradient_y);
  rates.artificial_y +=
      weight * (artificial_xy * gradient_x + (i.artificial_stress.yy + j.artificial_stress.yy) * gradient_y);
}

}  // namespace sphdrop
