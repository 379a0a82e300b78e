#pragma once
// Density by first-order moving least squares (Eq 13; Colagrossi & Landrini 2003).

#include <vector>

#include "particles/fluid_particles.hpp"
#include "sph/kernel.hpp"
#include "sph/sliced_neighbours.hpp"

namespace sphdrop {

/// The sums over a particle's neighbours, itself included, that first-order moving least squares needs. Distances are
/// in units of the particle spacing, so that all entries are of one order. T is double or a SIMD vector.
template <class T>
struct MovingLeastSquaresSums {
  T a00{0.0}, a0x{0.0}, a0y{0.0}, axx{0.0}, axy{0.0}, ayy{0.0};  ///< A = sum V W b b^T, b = (1, x, y)
  T m0{0.0}, mx{0.0}, my{0.0};                                   ///< sum m W b

  /// Adds a neighbour at distance (x, y) = (x_i - x_j)/d with kernel value w.
  [[gnu::always_inline]] void add(const T& x, const T& y, const T& w, const T& mass, const T& volume) {
    const T vw = volume * w, mw = mass * w;
    a00 += vw;
    a0x += vw * x;
    a0y += vw * y;
    axx += vw * x * x;
    axy += vw * x * y;
    ayy += vw * y * y;
    m0 += mw;
    mx += mw * x;
    my += mw * y;
  }
};

/// rho = sum m_j (beta . b_ij) W_ij with beta = A^-1 (1, 0, 0)^T. Falls back to order zero (Shepard) where
/// det A < 1e-3 a00^3, and to `own_density` for a particle without neighbours (`has_neighbours` false).
double moving_least_squares_density(const MovingLeastSquaresSums<double>& sums, double own_density,
                                    bool has_neighbours);

/// Corrected densities of the owned rows, from position, density and mass of all rows; kg/m3. `corrected` is indexed by
/// row and holds at least all rows. The particles themselves are left as they are.
void moving_least_squares_densities(const FluidParticles& fluid, const SlicedNeighbours& list,
                                    const SmoothingKernel& kernel, double spacing, std::vector<double>& corrected);

}  // namespace sphdrop
