#pragma once
// What one liquid particle contributes to the rates of another (Eqs 9, 12, 17, 18).

#include <variant>

#include "sph/artificial_viscosity.hpp"
#include "sph/kernel.hpp"
#include "sph/pair_separation.hpp"
#include "sph/physical_viscosity.hpp"

namespace sphdrop {

/// The quantities of a liquid particle that enter the pair formula. T is double or a SIMD vector.
template <class T>
struct FluidState {
  T x, y, velocity_x, velocity_y, density, pressure, mass, volume;
};

/// Sums over the neighbours of a particle.
template <class T>
struct FluidRates {
  T density_rate{0.0};    ///< drho/dt (9), kg/(m3 s)
  T acceleration_x{0.0};  ///< dv/dt (12) without contact, tension and gravity, m/s2
  T acceleration_y{0.0};
  T dissipation_rate{0.0};  ///< specific heating by Pi, W/kg
};

/// What the pair formula is made of: CubicSpline or WendlandC2, and ArtificialViscosity or PhysicalViscosity.
template <class Kernel = CubicSpline, class Viscosity = ArtificialViscosity>
struct FluidPairParameters {
  Kernel kernel;
  Viscosity viscosity;
};

/// One of them, as a case has chosen.
using AnyFluidPairParameters = std::variant<
    FluidPairParameters<CubicSpline, ArtificialViscosity>, FluidPairParameters<WendlandC2, ArtificialViscosity>,
    FluidPairParameters<CubicSpline, PhysicalViscosity>, FluidPairParameters<WendlandC2, PhysicalViscosity>>;

/// Adds what j contributes to i, the last step: products and sums alone. Out of the kernel's support, and for j = i,
/// that is an exact zero.
template <class Kernel, class Viscosity, class T>
[[gnu::always_inline]] inline void add_fluid_pair(const FluidPairParameters<Kernel, Viscosity>& parameters,
                                                  const InverseSeparation<T>& separation, const FluidState<T>& i,
                                                  const T& inverse_density_i, const FluidState<T>& j,
                                                  FluidRates<T>& rates) {
  const T &x = separation.x, &y = separation.y;
  const T velocity_x = i.velocity_x - j.velocity_x, velocity_y = i.velocity_y - j.velocity_y;
  const InversePair<T> inverse = separation.inverse();
  const T slope = parameters.kernel.slope(separation.distance) * inverse.first;  // grad W = slope x_ij
  const T velocity_dot_distance = velocity_x * x + velocity_y * y;
  const T velocity_dot_gradient = velocity_dot_distance * slope;

  // With the volume the density's rate is that whose pressure work is the force's, to rounding; (9) leaves what the
  // densities differ by.
  if constexpr (Viscosity::takes_volumes)
    rates.density_rate += i.density * j.volume * velocity_dot_gradient;
  else
    rates.density_rate += j.mass * velocity_dot_gradient;  // (9)
  const T viscous = j.mass * parameters.viscosity(velocity_dot_distance, separation.densities, inverse.second);
  // (12): m_j (p_i + p_j)/(rho_i rho_j) = V_j (p_i + p_j)/rho_i
  const T force = (j.volume * (i.pressure + j.pressure) * inverse_density_i + viscous) * slope;
  rates.acceleration_x -= force * x;
  rates.acceleration_y -= force * y;
  rates.dissipation_rate += T(0.5) * viscous * velocity_dot_gradient;
}

/// All its steps.
template <class Kernel, class Viscosity, class T>
[[gnu::always_inline]] inline void add_fluid_pair(const FluidPairParameters<Kernel, Viscosity>& parameters,
                                                  const FluidState<T>& i, const T& inverse_density_i,
                                                  const FluidState<T>& j, FluidRates<T>& rates) {
  const InverseSeparation<T> separation(Separation<T>(i.x - j.x, i.y - j.y), parameters.viscosity, i.density,
                                        j.density);
  add_fluid_pair(parameters, separation, i, inverse_density_i, j, rates);
}

}  // namespace sphdrop
