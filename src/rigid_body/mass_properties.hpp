#pragma once
// Mass, mass centre and moment of inertia of a body made of particles.

#include <cassert>
#include <concepts>
#include <cstddef>
#include <span>

#include "particles/vector.hpp"

namespace sphdrop {

/// Per metre of depth. The moment of inertia, kg m2/m, is that of point masses about the mass centre.
struct MassProperties {
  double mass = 0;
  Vector centre;
  double moment_of_inertia = 0;
};

/// Of a body that nobody stores: for_each_particle(add) calls add(position, mass) for every particle, m and kg per
/// metre of depth, in the same order each time. Sums run in that order.
template <class ForEachParticle>
MassProperties mass_properties(
    ForEachParticle&& for_each_particle) requires std::invocable<ForEachParticle, void (*)(Vector, double)> {
  MassProperties body;
  Vector first_moment;
  for_each_particle([&](Vector position, double mass) {
    body.mass += mass;
    first_moment += mass * position;
  });
  body.centre = first_moment / body.mass;
  for_each_particle(
      [&](Vector position, double mass) { body.moment_of_inertia += mass * squared_length(position - body.centre); });
  return body;
}

/// Shapes: [particles]; m, kg per metre of depth. Sums run in the order given.
inline MassProperties mass_properties(std::span<const Vector> positions, std::span<const double> masses) {
  assert(positions.size() == masses.size());
  return mass_properties([&](auto&& add) {
    for (std::size_t k = 0; k < positions.size(); ++k) add(positions[k], masses[k]);
  });
}

}  // namespace sphdrop
