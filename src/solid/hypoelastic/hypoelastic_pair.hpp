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

/// What a pair has in common: seen from the other particle the vectors change their sign and nothing else changes a bit,
/// so that one evaluation serves both.
template <class T>
struct HypoelasticInteraction {
  T velocity_x, velocity_y;  ///< v_i - v_j, m/s
  T gradient_x, gradient_y;  ///< grad_i W, 1/m3
  T velocity_dot_gradient;
  T viscosity;  ///< Pi_ij (17), m5/(kg s2)
  T weight;     ///< f^4 of (19)
  SymmetricTensor<T> stress;  ///< sigma_i + sigma_j, Pa
  T artificial_x, artificial_y;  ///< (R_i + R_j) grad_i W
};

/// How far two particles are apart: the first step of an interaction, which ends with a square root.
template <class T>
struct Separation {
  T x, y, squared_distance, distance;

  [[gnu::always_inline]] Separation(const HypoelasticState<T>& i, const HypoelasticState<T>& j)
      : x(i.x - j.x), y(i.y - j.y), squared_distance(x * x + y * y) {
    using std::max;
    using std::sqrt;
    distance = sqrt(max(squared_distance, T(1e-60)));
  }
};

/// The second step, a division: what the third divides by.
template <class T>
struct InverseSeparation : Separation<T> {
  T density_sum, denominator, inverse_product;

  [[gnu::always_inline]] InverseSeparation(const HypoelasticPairParameters& parameters, const Separation<T>& separation,
                                           const HypoelasticState<T>& i, const HypoelasticState<T>& j)
      : Separation<T>(separation),
        density_sum(i.density + j.density),
        denominator(parameters.viscosity.denominator(separation.squared_distance, density_sum)),
        inverse_product(InversePair<T>::of_product(separation.distance, denominator)) {}
};

/// The third step, products and sums alone.
template <class T>
[[gnu::always_inline]] inline HypoelasticInteraction<T> hypoelastic_interaction(
    const HypoelasticPairParameters& parameters, const InverseSeparation<T>& separation, const HypoelasticState<T>& i,
    const HypoelasticState<T>& j) {
  HypoelasticInteraction<T> pair;
  const T &x = separation.x, &y = separation.y, &distance = separation.distance;
  const InversePair<T> inverse(distance, separation.denominator, separation.inverse_product);
  pair.velocity_x = i.velocity_x - j.velocity_x;
  pair.velocity_y = i.velocity_y - j.velocity_y;
  const T slope = parameters.kernel.slope(distance) * inverse.first;  // grad W = slope x_ij
  pair.gradient_x = slope * x;
  pair.gradient_y = slope * y;
  const T velocity_dot_distance = pair.velocity_x * x + pair.velocity_y * y;
  pair.velocity_dot_gradient = velocity_dot_distance * slope;
  pair.viscosity = parameters.viscosity(velocity_dot_distance, separation.density_sum, inverse.second);

  pair.stress = {i.stress.xx + j.stress.xx, i.stress.yy + j.stress.yy, i.stress.xy + j.stress.xy};

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
[[gnu::always_inline]] inline void add_interaction(const HypoelasticInteraction<T>& pair, const T& inverse_density_own,
                                                   const T& neighbour_mass, const T& neighbour_volume,
                                                   HypoelasticRates<T>& rates) {
  // A product of two vectors is the same from both sides, a vector is added from one and subtracted from the other.
  const auto add = [](T& sum, const T& term) {
    if constexpr (from == SeenFrom::first)
      sum += term;
    else
      sum -= term;
  };
  rates.density_rate += neighbour_mass * pair.velocity_dot_gradient;  // (9)

  // (15, 16): dv^a/dx^b = sum V_j (v_j - v_i)^a grad^b W
  const T weighted_x = neighbour_volume * pair.gradient_x, weighted_y = neighbour_volume * pair.gradient_y;
  rates.gradient.xx -= pair.velocity_x * weighted_x;
  rates.gradient.xy -= pair.velocity_x * weighted_y;
  rates.gradient.yx -= pair.velocity_y * weighted_x;
  rates.gradient.yy -= pair.velocity_y * weighted_y;

  // (14): m_j (sigma_i + sigma_j)/(rho_i rho_j) = V_j (sigma_i + sigma_j)/rho_i
  const T viscous = neighbour_mass * pair.viscosity;
  const T elastic = neighbour_volume * inverse_density_own;
  const T xx = elastic * pair.stress.xx - viscous;
  const T yy = elastic * pair.stress.yy - viscous;
  const T xy = elastic * pair.stress.xy;
  add(rates.acceleration_x, xx * pair.gradient_x + xy * pair.gradient_y);
  add(rates.acceleration_y, xy * pair.gradient_x + yy * pair.gradient_y);
  rates.dissipation_rate += T(0.5) * viscous * pair.velocity_dot_gradient;

  const T weight = neighbour_mass * pair.weight;  // (19)
  add(rates.artificial_x, weight * pair.artificial_x);
  add(rates.artificial_y, weight * pair.artificial_y);
}

/// Adds what j contributes to i.
template <class T>
[[gnu::always_inline]] inline void add_hypoelastic_pair(const HypoelasticPairParameters& parameters,
                                                        const HypoelasticState<T>& i, const T& inverse_density_i,
                                                        const HypoelasticState<T>& j, HypoelasticRates<T>& rates) {
  const InverseSeparation<T> separation(parameters, Separation<T>(i, j), i, j);
  add_interaction<SeenFrom::first>(hypoelastic_interaction(parameters, separation, i, j), inverse_density_i, j.mass,
                                   j.volume, rates);
}

}  // namespace sphdrop
