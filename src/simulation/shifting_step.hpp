#pragma once
// Particle shifting in a run: when it is due, how far, and what it adds to the energy.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "fluid/particle_shifting.hpp"
#include "simulation/contact_step.hpp"
#include "simulation/distribution.hpp"
#include "simulation/shared_energy.hpp"

namespace sphdrop {

/// In a step that is due: find() between the forces and the motion, apply() before the drift, whose largest
/// displacements then include it.
class ShiftingStep {
 public:
  ShiftingStep(const Communicator& communicator, const Case& input, const SmoothingKernel& kernel);

  bool is_enabled() const { return is_enabled_; }
  bool is_due(std::int64_t step) const { return is_enabled_ && step > 0 && step % interval_ == 0; }

  /// The owned rows' displacements; positions of ghosts, surface_orientation and the contact's forces must be good.
  /// What is along the contact's force is left out: it would do work on the springs. `largest_speed` of the liquid in
  /// m/s, `step` in s.
  void find(const FluidParticles& fluid, const Distribution& distribution, const ContactStep& contact,
            double largest_speed, double step);
  /// By row, after find().
  std::span<const double> displacement_x() const { return x_; }
  std::span<const double> displacement_y() const { return y_; }
  /// Moves the owned rows, once; velocities stay as they are, densities but for what returns the volume. What that adds
  /// to the energy of compression and gravity (m/s2) goes to shift_energy. `kick`: from the half step before to the one
  /// to come, s.
  void apply(FluidParticles& fluid, Vector gravity, double kick);

  /// What shifts have added to the energy of surface, adhesion and gauge so far.
  SharedEnergy& work() { return work_; }
  const SharedEnergy& work() const { return work_; }
  /// Counts what the step under way adds.
  void book_work() { work_.book(); }
  /// Counts it anew.
  void start_ledger() { work_.restart(); }

  /// Collective.
  std::vector<double> to_numbers() const { return {work_.total()}; }
  /// Throws std::invalid_argument where the numbers are not of to_numbers().
  void from_numbers(std::span<const double> numbers);

 private:
  bool is_enabled_;
  std::int64_t interval_;
  double rest_density_, sound_speed_;
  ShiftingParameters parameters_;
  bool is_found_ = false;
  SharedEnergy work_;
  std::vector<double> x_, y_;  // by row: gradients, then displacements
  std::vector<double> concentration_, returned_, contact_x_, contact_y_;
};

}  // namespace sphdrop
