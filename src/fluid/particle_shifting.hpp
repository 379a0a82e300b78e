#pragma once
// Small displacements that keep the liquid's particles evenly spread (Lind et al. 2012; Sun et al. 2017).

#include <vector>

#include "particles/fluid_particles.hpp"
#include "sph/kernel.hpp"
#include "sph/sliced_neighbours.hpp"

namespace sphdrop {

struct ShiftingParameters {
  SmoothingKernel kernel;
  double smoothing_length = 0;  ///< h, m
  double spacing = 0;           ///< d, m
};

/// What the listed rows' shifts go by, 1/m, by row into x and y: sum_j d^2 (s + max(0, (W/W(d))^4 - 3)) grad W, and
/// the particles' concentration C = sum_j d^2 W, the row itself included: 1 in a lattice. The second term pushes apart
/// what is nearer than 0.8 d. The first, the gradient of C, spreads a crowd: s rises from 0 at C = 1 to 1 at C = 1.05,
/// as particles that spread into a void would take its volume for the liquid's.
void concentration_gradients(const FluidParticles& fluid, const SlicedNeighbours& list,
                             const ShiftingParameters& parameters, std::vector<double>& x, std::vector<double>& y,
                             std::vector<double>& concentration);

/// The displacement that a concentration's gradient asks for in `duration` (s) at the largest speed v_max (m/s):
/// -2 h v_max duration grad C, at most 0.05 d, m. `surface` is the particle's surface_orientation M: what (1 - M)
/// leaves of the displacement is along the surface.
Vector shift(Vector concentration_gradient, double largest_speed, double duration, const ShiftingParameters& parameters,
             double surface_xx, double surface_xy, double surface_yy);

/// What a particle within the liquid gets of its density at rest where its concentration is off, so that pressure
/// brings the volume back that shifts have taken or given: C - 1 beyond +-0.02, at most 0.05 of it, times the share
/// v_max duration/(10 h), at most 1. Arguments as of shift().
double returned_density(double concentration, double largest_speed, double duration,
                        const ShiftingParameters& parameters);

/// Unit vectors n with weights w added up to M = sum w n (x) n.
struct OrientationSums {
  double xx = 0, xy = 0, yy = 0;
  void add(Vector n, double weight) {
    xx += weight * (n.x * n.x);
    xy += weight * (n.x * n.y);
    yy += weight * (n.y * n.y);
  }
};

/// M over its larger eigenvalue: 1 - M takes off a vector what is along the prevailing normal, whichever its sign, and
/// the more of the rest the more the normals differ. Zero for no normals.
OrientationSums normalised(const OrientationSums& sums);

}  // namespace sphdrop
