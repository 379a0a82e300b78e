#pragma once
// Drops, centred at the origin (method: Sec. 4.1; the arrangement of the particles is a choice of this program).

#include <cstdint>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// Particles of a drop. Shapes: [particles]; m, kg per metre of depth.
struct DropParticles {
  std::vector<Vector> positions;
  std::vector<double> masses;
  std::vector<Vector> velocities = {};  ///< beside that of the whole drop, m/s; empty: none
};

/// A round drop of `radius` R (m) as concentric rings, ring k at radius (k + 1/2) d', d' = R / round(R/d), with
/// round(2 pi (k + 1/2)) particles that carry the density times the area of their annulus: exactly rho pi R^2 in all.
/// Ring by ring from the centre. `spacing` d in m, `density` in kg/m3.
DropParticles round_drop_of_rings(double radius, double spacing, double density);

/// A round drop of `radius` (m) cut out of a square lattice that is symmetric about its centre, with equal masses that
/// add up to rho pi R^2; column by column.
DropParticles round_drop_of_lattice(double radius, double spacing, double density);

/// An elliptic drop of the semi-axes `half_width` and `half_height` (m), cut out of the lattice likewise.
DropParticles elliptic_drop(double half_width, double half_height, double spacing, double density);

/// A square drop of `side` (m): n x n particles, n = round(side/d), at the centres of n x n cells; column by column.
DropParticles square_drop(double side, double spacing, double density);

/// Moves every coordinate by a random amount, uniform in +-`amplitude` (m); the same for the same seed on every
/// machine.
void jitter_positions(std::vector<Vector>& positions, double amplitude, std::int64_t seed);

/// The velocity that sets a drop oscillating, m/s (Sec. 4.1): the divergence-free field with stream function
/// V0 (x y / r0) exp(-r/r0), i.e. v_x = V0 (x/r0)(1 - y^2/(r0 r)) exp(-r/r0), v_y = -V0 (y/r0)(1 - x^2/(r0 r))
/// exp(-r/r0). `from_centre` in m, `amplitude` V0 in m/s, `decay_radius` r0 in m.
Vector oscillation_velocity(Vector from_centre, double amplitude, double decay_radius);

}  // namespace sphdrop
