#pragma once
// Damping in proportion to mass, as Rayleigh's with a stiffness part of 0: brings a beam to rest.

#include "particles/solid_particles.hpp"

namespace sphdrop {

/// Adds a = -rate v to the acceleration of a row, and the heat it makes, rate |v|^2 per mass, to its dissipation rate.
/// `rate` in 1/s. A mode of angular frequency omega is damped by rate/(2 omega) of its critical damping: an amplitude
/// decays as exp(-rate t/2). Held particles have no velocity to be damped.
inline void add_mass_proportional_damping(SolidParticles& solid, std::size_t row, double rate) {
  const Vector v = solid.velocity.at(row);
  solid.acceleration.x[row] -= rate * v.x;
  solid.acceleration.y[row] -= rate * v.y;
  solid.dissipation_rate[row] += rate * squared_length(v);
}

/// To all owned rows.
inline void add_mass_proportional_damping(SolidParticles& solid, double rate) {
  solid.for_each_owned([&](std::size_t row) { add_mass_proportional_damping(solid, row, rate); });
}

}  // namespace sphdrop
