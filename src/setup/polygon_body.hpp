#pragma once
// Solids of any outline: elastic ones, filled with particles, and rigid ones, which are their border.

#include "config/case.hpp"
#include "setup/initial_particles.hpp"

namespace sphdrop {

/// An elastic body with the outline solid.polygon on the lattice of `spacing` d (m): particles at ((i + 1/2) d, (j +
/// 1/2) d), the lattice turned about the origin to solid.lattice_direction, each with the mass of its part of the
/// polygon (fill_with_lattice()). Those within a region of solid.clamps are held. The boundary is the polygon moved
/// inwards by d/2, so that the surface that a drop meets is the polygon itself; its vertices go with the four particles
/// about them, outside them as the body there would go (bilinear). Throws SetupError where the polygon is too thin, a
/// clamp holds nothing, or nothing is left to move.
InitialSolid build_polygon_body(const Case::Solid& solid, double spacing);

/// A rigid one: particles that never move along the polygon moved inwards by d/2, at most d apart. Throws SetupError
/// where the polygon is thinner than d.
InitialSolid build_obstacle(const Case::Solid& solid, double spacing);

}  // namespace sphdrop
