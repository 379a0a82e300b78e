#pragma once
// Density diffusion of the delta-SPH scheme (Antuono, Colagrossi, Marrone, Molteni 2010), in the place of a density
// correction.

#include "particles/fluid_particles.hpp"
#include "sph/artificial_viscosity.hpp"
#include "sph/kernel.hpp"
#include "sph/sliced_neighbours.hpp"

namespace sphdrop {

/// The sums over a particle's neighbours that the renormalised gradient of its density needs. T is double or a SIMD
/// vector.
template <class T>
struct DensityGradientSums {
  T moment_xx{0.0}, moment_xy{0.0}, moment_yy{0.0};  ///< M = sum V_j (x_j - x_i) (x) grad W
  T x{0.0}, y{0.0};                                  ///< sum V_j (rho_j - rho_i) grad W

  /// Adds a neighbour at (x_i - x_j), grad W = slope (x_i - x_j).
  [[gnu::always_inline]] void add(const T& dx, const T& dy, const T& slope, const T& volume,
                                  const T& density_difference) {
    const T weight = volume * slope;
    moment_xx -= weight * dx * dx;
    moment_xy -= weight * dx * dy;
    moment_yy -= weight * dy * dy;
    x += weight * density_difference * dx;
    y += weight * density_difference * dy;
  }
};

/// M^-1 applied to the sum: exact for a linear field, at free surfaces too, kg/m4. Zero where M is nearly singular
/// (neighbours on a line, or none): the diffusion is then that of Molteni & Colagrossi 2009.
Vector renormalised_density_gradient(const DensityGradientSums<double>& sums);

/// Sets density_gradient of the listed rows, from position, density and mass of all rows.
void density_gradients(FluidParticles& fluid, const SlicedNeighbours& list, const SmoothingKernel& kernel);

/// Adds to density_rate of the listed rows, and stores as density_diffusion,
///   delta h c sum_j V_j [2 (rho_j - rho_i) x_ji/r^2 - (g_i + g_j)] . grad W, g the gradients of density_gradients().
/// Vanishes for a linear field; sum V_i of it over all particles is zero. `coefficient` is delta h c, m2/s.
void add_density_diffusion(FluidParticles& fluid, const SlicedNeighbours& list, const SmoothingKernel& kernel,
                           double coefficient);

}  // namespace sphdrop
