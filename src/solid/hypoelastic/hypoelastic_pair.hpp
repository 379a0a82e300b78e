#pragma once
// What one solid particle contributes to the rates of another (Eqs 7-9, 14-19).

#include <algorithm>
#include <cmath>

#include "solid/hypoelastic/jaumann_rate.hpp"
#include "sph/artificial_viscosity.hpp"
#include "sph/kernel.hpp"
#include "sph/pair_separation.hpp"

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

/// What the pair formula is made of: ArtificialViscosity, or the same where beta is zero.
template <class Viscosity>
struct HypoelasticPairParametersWith {
  CubicSpline kernel;
  Viscosity viscosity;
  double inverse_kernel_at_spacing = 0;  ///< 1/W(d) of Eq 19, m2
};
using HypoelasticPairParameters = HypoelasticPairParametersWith<ArtificialViscosity>;

/// What a pair has in common: seen from the other particle the vectors change their sign and nothing else changes a
/// bit, so that one evaluation serves both. Differences of velocity and sums of stress are not kept: they cost less
/// than their place in the cache.
template <class T>
struct HypoelasticInteraction {
  T gradient_x, gradient_y;  ///< grad_i W, 1/m3
  T velocity_dot_gradient;
  T viscosity;                   ///< Pi_ij (17), m5/(kg s2)
  T weight;                      ///< f^4 of (19)
  T artificial_x, artificial_y;  ///< (R_i + R_j) grad_i W
};

/// The last step of a pair: products and sums alone.
template <class Viscosity, class T>
[[gnu::always_inline]] inline HypoelasticInteraction<T> hypoelastic_interaction(
    const HypoelasticPairParametersWith<Viscosity>& parameters, const InverseSeparation<T>& separation,
    const HypoelasticState<T>& i, const HypoelasticState<T>& j) {
  HypoelasticInteraction<T> pair;
  const T &x = separation.x, &y = separation.y, &distance = separation.distance;
  const InversePair<T> inverse = separation.inverse();
  const T slope = parameters.kernel.slope(distance) * inverse.first;  // grad W = slope x_ij
  pair.gradient_x = slope * x;
  pair.gradient_y = slope * y;
  const T velocity_dot_distance = (i.velocity_x - j.velocity_x) * x + (i.velocity_y - j.velocity_y) * y;
  pair.velocity_dot_gradient = velocity_dot_distance * slope;
  pair.viscosity = parameters.viscosity(velocity_dot_distance, separation.densities, inverse.second);

  // (19): (R_i + R_j) f^4, f = W(r)/W(d)
  const T f = parameters.kernel.value(distance) * T(parameters.inverse_kernel_at_spacing);
  const T squared_f = f * f;
  pair.weight = squared_f * squared_f;
  const T artificial_xy = i.artificial_stress.xy + j.artificial_stress.xy;
  pair.artificial_x =
      (i.artificial_stress.xx + j.artificial_stress.xx) * pair.gradient_x + artificial_xy * pair.gradient_y;
  pair.artificial_y =
      artificial_xy * pair.gradient_x + (i.artificial_stress.yy + j.artificial_stress.yy) * pair.gradient_y;
  return pair;
}

/// Whose sums are added to: those of the particle that the interaction was evaluated for, or of the other one.
enum class SeenFrom { first, second };

/// Adds to a particle's sums what its neighbour contributes. Out of the kernel's support, and for a particle with
/// itself, that is an exact zero.
template <SeenFrom from, class T>
[[gnu::always_inline]] inline void add_interaction(const HypoelasticInteraction<T>& pair,
                                                   const HypoelasticState<T>& own, const T& inverse_density_own,
                                                   const HypoelasticState<T>& neighbour, HypoelasticRates<T>& rates) {
  // What has the gradient as a factor changes its sign with the side.
  const auto add = [](T& sum, const T& term) {
    if constexpr (from == SeenFrom::first)
      sum += term;
    else
      sum -= term;
  };
  const auto subtract = [](T& sum, const T& term) {
    if constexpr (from == SeenFrom::first)
      sum -= term;
    else
      sum += term;
  };
  const T velocity_x = own.velocity_x - neighbour.velocity_x, velocity_y = own.velocity_y - neighbour.velocity_y;
  rates.density_rate += neighbour.mass * pair.velocity_dot_gradient;  // (9)

  // (15, 16): dv^a/dx^b = sum V_j (v_j - v_i)^a grad^b W
  const T weighted_x = neighbour.volume * pair.gradient_x, weighted_y = neighbour.volume * pair.gradient_y;
  subtract(rates.gradient.xx, velocity_x * weighted_x);
  subtract(rates.gradient.xy, velocity_x * weighted_y);
  subtract(rates.gradient.yx, velocity_y * weighted_x);
  subtract(rates.gradient.yy, velocity_y * weighted_y);

  // (14): m_j (sigma_i + sigma_j)/(rho_i rho_j) = V_j (sigma_i + sigma_j)/rho_i
  const T viscous = neighbour.mass * pair.viscosity;
  const T elastic = neighbour.volume * inverse_density_own;
  const T xx = elastic * (own.stress.xx + neighbour.stress.xx) - viscous;
  const T yy = elastic * (own.stress.yy + neighbour.stress.yy) - viscous;
  const T xy = elastic * (own.stress.xy + neighbour.stress.xy);
  add(rates.acceleration_x, xx * pair.gradient_x + xy * pair.gradient_y);
  add(rates.acceleration_y, xy * pair.gradient_x + yy * pair.gradient_y);
  rates.dissipation_rate += T(0.5) * viscous * pair.velocity_dot_gradient;

  const T weight = neighbour.mass * pair.weight;  // (19)
  add(rates.artificial_x, weight * pair.artificial_x);
  add(rates.artificial_y, weight * pair.artificial_y);
}

/// Adds what j contributes to i.
template <class Viscosity, class T>
[[gnu::always_inline]] inline void add_hypoelastic_pair(const HypoelasticPairParametersWith<Viscosity>& parameters,
                                                        const HypoelasticState<T>& i, const T& inverse_density_i,
                                                        const HypoelasticState<T>& j, HypoelasticRates<T>& rates) {
  const InverseSeparation<T> separation(Separation<T>(i.x - j.x, i.y - j.y), parameters.viscosity, i.density,
                                        j.density);
  add_interaction<SeenFrom::first>(hypoelastic_interaction(parameters, separation, i, j), i, inverse_density_i, j,
                                   rates);
}

}  // namespace sphdrop
