#pragma once
// Mass, mass centre and moment of inertia of a body made of particles.

#include <cassert>
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

/// Shapes: [particles]; m, kg per metre of depth. Sums run in the order given.
inline MassProperties mass_properties(std::span<const Vector> positions, std::span<const double> masses) {
  assert(positions.size() == masses.size());
  MassProperties body;
  Vector first_moment;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    body.mass += masses[k];
    first_moment += masses[k] * positions[k];
  }
  body.centre = first_moment / body.mass;
  for (std::size_t k = 0; k < positions.size(); ++k)
    body.moment_of_inertia += masses[k] * squared_length(positions[k] - body.centre);
  return body;
}

}  // namespace sphdrop
