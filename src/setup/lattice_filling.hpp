#pragma once
// A polygon filled with the particles of the square lattice, without a staircase in area, mass and moments.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/plane_moments.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// All lengths in spacings. The lattice's squares have their corners at whole numbers; particle k stands in the middle
/// of the square of column and row k. Column by column, from bottom to top in a column.
struct LatticeFilling {
  std::vector<std::int64_t> column, row;
  /// The parts of the polygon that belong to a particle, by direction (InitialSolid::quadrants). Together they are the
  /// polygon.
  std::vector<std::array<PlaneMoments, 4>> quadrants;

  Vector position(std::size_t k) const {
    return {static_cast<double>(column[k]) + 0.5, static_cast<double>(row[k]) + 0.5};
  }
  double area(std::size_t k) const;
  /// The particle of this square, or -1.
  std::int32_t at(std::int64_t wanted_column, std::int64_t wanted_row) const;
};

/// A particle for every square of which at least a quarter lies within the counterclockwise `polygon`, and that is one
/// of 2 x 2 such squares. It has its square's part of the polygon; what lies in other squares belongs to the particle
/// nearest to it. Throws SetupError, which names places in m by `spacing`, where the polygon is too thin for that:
/// where it falls into pieces, or a part of it is farther than four spacings from all particles.
LatticeFilling fill_with_lattice(std::span<const Vector> polygon, double spacing);

}  // namespace sphdrop
