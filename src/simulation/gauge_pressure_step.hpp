#pragma once
// The gauge pressure of a distributed drop.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "decomposition/communicator.hpp"
#include "fluid/gauge_pressure.hpp"
#include "particles/fluid_particles.hpp"
#include "setup/initial_particles.hpp"
#include "simulation/surface_tension_step.hpp"

namespace sphdrop {

/// In a step: relax(), start(), finish(). What a step finds of the pressures is used by the next one, so that the sums
/// over all ranks are under way while the forces are computed. There is one drop, and all its fragments share its
/// pressure; each further drop would have a gauge of its own.
class GaugePressureStep {
 public:
  GaugePressureStep(const Communicator& communicator, const Case& input, const InitialFluid& initial);

  bool is_enabled() const { return is_enabled_; }
  /// p_ref at the present instant, Pa; 0 where it is not enabled. The same on every rank.
  double pressure() const { return gauge_.pressure; }
  /// The energy of its push on the surface, -p_ref (A - V0), J/m: A the `area` within the curves (m2), V0 the drop's at
  /// rest density.
  double energy(double area) const { return -gauge_.pressure * (area - rest_area_); }
  /// What changes of p_ref have added to that energy so far, J/m. What they take off the energy of compression is in
  /// the particles' gauge_energy.
  double adjustment() const { return adjustment_; }
  /// Counts adjustment() anew.
  void start_ledger() { adjustment_ = 0; }

  /// Lets p_ref follow over the last `step` (s), and takes the change off the owned rows' staggered densities.
  void relax(FluidParticles& fluid, double step);
  /// Collective. Sums up the owned rows' pressures, those counted from zero, and the area within the surface.
  void start(const FluidParticles& fluid, const SurfaceTensionStep& surface);
  /// Waits for what start() began, if it did.
  void finish();

  std::vector<double> to_numbers() const { return {gauge_.pressure, gauge_.target, area_, adjustment_}; }
  /// Throws std::invalid_argument where the numbers are not of to_numbers().
  void from_numbers(std::span<const double> numbers);

 private:
  bool is_enabled_;
  double relaxation_time_, lowest_, rest_density_, inverse_squared_sound_speed_;
  double pressure_scale_, particle_count_, rest_area_, area_quantum_;
  double area_ = 0, adjustment_ = 0;
  GaugePressure gauge_;
  PendingSum pending_;
};

}  // namespace sphdrop
