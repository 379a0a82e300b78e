#pragma once
// One sweep over the hypoelastic solid's neighbours: density rate, velocity gradient and acceleration together.

#include <span>

#include "particles/solid_particles.hpp"
#include "solid/elasticity.hpp"
#include "solid/hypoelastic/hypoelastic_pair.hpp"
#include "sph/offset_neighbours.hpp"

namespace sphdrop {

struct HypoelasticParameters {
  HypoelasticPairParameters pair;
  ElasticMaterial material;
  double trace_factor = 1.0 / 3.0;           ///< k of Eq 6
  double artificial_stress_coefficient = 0;  ///< eps of Eq 20
};

class HypoelasticSweep {
 public:
  explicit HypoelasticSweep(const HypoelasticParameters& parameters) : parameters_(parameters) {}

  /// Pressure (5), volume, total stress and artificial stress (20-23) of the rows, from density and deviatoric stress.
  void update_stress(SolidParticles& solid, std::span<const RowRange> rows) const;

  enum class Blocks { without_ghosts, with_ghosts };
  /// Sets density_rate, acceleration, deviatoric_stress_rate, dissipation_rate and artificial_stress_power of the rows
  /// in those blocks that do, or do not, need ghosts.
  void apply(SolidParticles& solid, const OffsetNeighbours& list, Blocks which) const;

 private:
  HypoelasticParameters parameters_;
  mutable Column<double> shared_;  // interactions, of no meaning between calls
};

}  // namespace sphdrop
