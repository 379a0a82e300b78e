#pragma once
// Solids: beams held between the strips of their clamps (Sec. 3) and the rigid wall.

#include "config/case.hpp"
#include "setup/initial_particles.hpp"

namespace sphdrop {

/// A beam on the square lattice of `spacing` d (m): free part x in [0, L], 0 <= y <= H, particles at cell centres. The
/// beam goes on into the clamp, x in [-clamp_length, 0], where it is free to move between two strips of `clamp_layers`
/// fixed rows, one below it and one above; in an ideal clamp it is itself fixed, and there are no strips. With
/// fixed_fixed_beam the same clamp follows beyond x = L.
///
/// The boundary runs along the strips' outer and free faces and the free surface of the beam; it is open behind the
/// clamps. Cantilever: one polyline, over the top to the free end and back along the underside, probe: the last column.
/// Beam fixed at both ends: the top, left to right, and the underside, right to left; probe: the middle of the span.
/// There the middle probe of both is: the column or the two columns about x = L/2.
///
/// Throws SetupError where L or H is not a whole number of spacings, H has fewer than two rows or the clamp is empty,
/// and for an initial tip velocity of any solid but the cantilever. Particles of other shares are nowhere stored.
InitialSolid build_beam(const Case::Solid& solid, double spacing, Share share = {});

/// One row of round(W/d) fixed particles along y = -d/2, centred on x = 0, so that the surface is y = 0; boundary from
/// left to right, no probe. W is solid.length.
InitialSolid build_rigid_wall(const Case::Solid& solid, double spacing);

/// The first bending mode of a clamped-free beam at x = `fraction` L, scaled to 1 at the free end:
/// (cosh bx - cos bx) - s (sinh bx - sin bx), b L = 1.8751 (Timoshenko; Blevins, Table 8-1).
double first_cantilever_mode(double fraction);

}  // namespace sphdrop
