#pragma once
// Supports of elastic solids, and where their deflection is watched.

#include "config/case.hpp"
#include "setup/initial_particles.hpp"

namespace sphdrop {

/// Lets the particle nearest to each place of solid.pinned, held_in_x and held_in_y be held, and not start to move.
/// Throws SetupError for a place farther than `spacing` (m) from every particle.
void add_holds(const Case::Solid& solid, double spacing, InitialSolid& body);

/// The particles nearest to solid.probe, which replace the body's own. Without a probe, of a body that has none: the
/// free particle farthest from those that are held, or the last one where none is. Throws likewise.
void choose_probe(const Case::Solid& solid, double spacing, InitialSolid& body);

}  // namespace sphdrop
