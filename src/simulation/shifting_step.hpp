#pragma once
// Particle shifting in a run: when it is due, how far, and what it adds to the energy.

#include <vector>

#include "config/case.hpp"
#include "fluid/particle_shifting.hpp"
#include "simulation/distribution.hpp"

namespace sphdrop {

/// In a step that is due: find() between the forces and the motion, apply() before the drift, whose largest
/// displacements then include it.
class ShiftingStep {
 public:
  ShiftingStep(const Case& input, const SmoothingKernel& kernel);

  bool is_enabled() const { return is_enabled_; }
  bool is_due(std::int64_t step) const { return is_enabled_ && step > 0 && step % interval_ == 0; }

  /// The owned rows' displacements; positions of ghosts and surface_orientation must be good. `largest_speed` of the
  /// liquid in m/s, `step` in s.
  void find(const FluidParticles& fluid, const Distribution& distribution, double largest_speed, double step);
  /// Moves the owned rows, once. Velocities and densities stay as they are.
  void apply(FluidParticles& fluid);

 private:
  bool is_enabled_;
  std::int64_t interval_;
  ShiftingParameters parameters_;
  bool is_found_ = false;
  std::vector<double> x_, y_;  // by row: gradients, then displacements
};

}  // namespace sphdrop
