#pragma once
// Particles as a run starts with them. Positions in m, velocities in m/s, masses in kg per metre of depth.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// Shapes: [particles].
struct InitialFluid {
  std::vector<Vector> positions, velocities;
  std::vector<double> masses;
  Vector centre;  ///< of the drop
};

/// Shapes: [particles]. A beam's particles stand in lattice order: column by column in x, from bottom to top in a
/// column.
struct InitialSolid {
  std::vector<Vector> positions, velocities;
  std::vector<double> masses;
  std::vector<char> is_fixed;  ///< 1: a particle of a clamp or wall, which never moves
  /// The boundary as indices of particles, the solid on the right when walking along.
  std::vector<std::vector<std::int32_t>> contact_polylines;
  /// The particles whose mean displacement is the deflection delta(t); ascending.
  std::vector<std::int32_t> deflection_probe;
  /// Those of mid-span, ascending; the same as deflection_probe for a beam fixed at both ends.
  std::vector<std::int32_t> middle_probe;
  std::size_t mobile_count = 0;
  double top = 0;  ///< y of the surface a drop falls on, m
};

}  // namespace sphdrop
