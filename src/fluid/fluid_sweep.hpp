#pragma once
// One sweep over the liquid's neighbours: density rate, acceleration and heating together.

#include <span>
#include <vector>

#include "fluid/fluid_pair.hpp"
#include "particles/fluid_particles.hpp"
#include "sph/sliced_neighbours.hpp"

namespace sphdrop {

/// The liquid's sweep and the records it reads: what a neighbour contributes lies in one cache line, so that a lane
/// fetches it with one load.
class FluidSweep {
 public:
  explicit FluidSweep(const AnyFluidPairParameters& parameters) : parameters_(parameters) {}

  /// Room for all rows of `fluid` and its padding; call after the number of rows changed.
  void resize(const FluidParticles& fluid);
  /// Copies position, velocity, density, mass and volume of the rows into the records, and pressure less
  /// `gauge_pressure` (Pa), which is all that acts between particles.
  void pack(const FluidParticles& fluid, std::span<const RowRange> rows, double gauge_pressure = 0);
  /// Sets density_rate, acceleration and dissipation_rate of the slices' rows.
  void apply(FluidParticles& fluid, const SlicedNeighbours& list) const;

 private:
  AnyFluidPairParameters parameters_;
  Column<double> records_;  // [row][8]
};

}  // namespace sphdrop
