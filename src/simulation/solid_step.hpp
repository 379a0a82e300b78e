#pragma once
// The part of a step that belongs to the solid, for each of its formulations.

#include <memory>
#include <optional>
#include <vector>

#include "config/case.hpp"
#include "decomposition/exact_sum.hpp"
#include "particles/solid_particles.hpp"
#include "setup/initial_particles.hpp"
#include "simulation/distribution.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "time_integration/leapfrog.hpp"

namespace sphdrop {

/// In a step: predict(); sweep_inner() while the columns of ghosted() travel; sweep_rest() when they are there; other
/// forces are added to acceleration; move(). None of this knows who the other ranks are.
class SolidStep {
 public:
  SolidStep() = default;
  SolidStep(const SolidStep&) = delete;
  SolidStep& operator=(const SolidStep&) = delete;
  virtual ~SolidStep() = default;

  /// Which particles are neighbours, and so who owns them, follows from their places in the undeformed body.
  virtual bool is_total_lagrangian() const = 0;
  /// How far neighbours are apart at most in the undeformed body of a total-Lagrangian solid, m.
  virtual double reach() const { return 0.0; }
  /// What goes to ghosts in every step.
  virtual std::vector<Column<double>*> ghosted(SolidParticles& solid) const = 0;
  /// After every redistribution.
  virtual void relist(SolidParticles& solid, const Distribution& distribution) = 0;
  /// Of the owned rows, what sweeps and ghosts need at the present instant; `previous_step` in s.
  virtual void predict(SolidParticles& solid, double previous_step) = 0;
  virtual void sweep_inner(SolidParticles& solid, const Distribution& distribution) = 0;
  /// Afterwards acceleration by the solid's own stress is set, and dissipation_rate where is_heated().
  virtual void sweep_rest(SolidParticles& solid, const Distribution& distribution) = 0;
  virtual MotionMaxima move(SolidParticles& solid, StepLengths steps, double speed_limit) = 0;

  /// Between evaluation and move: sets density, pressure and stress of the owned rows where the step leaves them out.
  virtual void complete(SolidParticles& solid) const = 0;
  /// Adds the elastic energy of what this rank owns, J/m.
  virtual void add_elastic_energy(const SolidParticles& solid, ExactSum& sum) const = 0;

  /// What cannot be computed on: the place in the undeformed body turned inside out.
  struct Inversion {
    std::int64_t id = 0;  ///< of a particle there
    double determinant = 0;
  };
  virtual std::optional<Inversion> inversion(const SolidParticles&) const { return std::nullopt; }
};

/// The step of the case's formulation. `first_id`: global id of the solid's first particle. Throws SetupError where the
/// particles do not suit it.
std::unique_ptr<SolidStep> make_solid_step(const Case& input, const HypoelasticParameters& parameters,
                                           const InitialSolid& initial, std::int64_t first_id);

}  // namespace sphdrop
