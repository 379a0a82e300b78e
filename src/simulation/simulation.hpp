#pragma once
// The state of a run and its step (Sec. 2.6).

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "config/case.hpp"
#include "decomposition/communicator.hpp"
#include "fluid/fluid_sweep.hpp"
#include "io/checkpoint.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"
#include "setup/initial_particles.hpp"
#include "simulation/contact_step.hpp"
#include "simulation/derived_parameters.hpp"
#include "simulation/distribution.hpp"
#include "simulation/gauge_pressure_step.hpp"
#include "simulation/phase_timer.hpp"
#include "simulation/point_supports.hpp"
#include "simulation/rigid_body_step.hpp"
#include "simulation/saved_simulation.hpp"
#include "simulation/shifting_step.hpp"
#include "simulation/solid_bodies.hpp"
#include "simulation/solid_step.hpp"
#include "simulation/surface_tension_step.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "time_integration/leapfrog.hpp"
#include "time_integration/time_step.hpp"

namespace sphdrop {

/// A state that must not be computed on: a NaN, a particle too fast, lost or too deep in the solid. Thrown on all ranks
/// at the same step with the same text, which names the particle.
struct SafetyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A run, step by step: evaluate() brings everything to the present instant, move() goes on to the next. All calls are
/// collective. Between the two the state at time() may be looked at.
class Simulation {
 public:
  /// Drop and solid are whole or have at least this rank's share (rank, size) of their particles.
  Simulation(const Communicator& communicator, const Case& input, const InitialFluid& initial_fluid,
             const InitialSolid& initial_solid);

  /// Takes up the run of a checkpoint, before the first evaluate(): every later step has the same bits as if that run
  /// had never stopped. Throws CheckpointError if the checkpoint is not of these particles.
  void restore(const Checkpoint& checkpoint);

  /// Waits for what move() left under way. Throws SafetyError if the state is not sound.
  void settle();
  /// Everything that belongs to the present instant: predicted values, stresses, forces, the step to come. Settles
  /// first where that has not been done.
  void evaluate();
  /// Kick and drift to the next instant (Eqs 36-39). The largest `request` of all ranks is known after settle().
  void move(double request = 0);

  /// Brings the solid's density, pressure and stress, which some formulations leave out of a step, to the present
  /// instant; between evaluate() and move().
  void complete_solid() { solid_step_->complete(solid_); }

  /// What was asked for with the last move(), the same on every rank; good after settle().
  double request() const { return request_; }
  /// All that the steps to come start from; between settle() and evaluate().
  SavedSimulation save() const;

  double time() const { return time_; }
  std::int64_t step() const { return step_; }
  /// The step to come, s; good after evaluate().
  double time_step() const { return steps_.next; }
  /// Of the fastest particle of the drop on any rank at the last half step, m/s; good after evaluate().
  double largest_drop_speed() const;

  const Case& input() const { return case_; }
  const Communicator& communicator() const { return communicator_; }
  const DerivedParameters& parameters() const { return parameters_; }
  const FluidParticles& fluid() const { return fluid_; }
  const SolidParticles& solid() const { return solid_; }
  const SurfaceTensionStep& surface_tension() const { return surface_tension_; }
  const ContactStep& contact() const { return contact_; }
  const RigidBodyStep& rigid_body() const { return rigid_body_; }
  const SolidStep& solid_step() const { return *solid_step_; }
  const GaugePressureStep& gauge() const { return gauge_; }
  const ShiftingStep& shifting() const { return shifting_; }
  const Distribution& distribution() const { return distribution_; }
  /// Global ids of the particles whose mean displacement is the deflection.
  const std::vector<std::int64_t>& deflection_probe() const { return deflection_probe_; }
  /// Those of the beam's mid-span section.
  const std::vector<std::int64_t>& middle_probe() const { return middle_probe_; }
  /// Those of deflection of each solid of several; empty where there is one.
  const std::vector<std::vector<std::int64_t>>& probes_of_solids() const { return probes_of_solids_; }
  /// The solids among the particles.
  const std::vector<SolidIds>& solids() const { return solids_; }
  std::int64_t fluid_total() const { return fluid_total_; }
  std::int64_t solid_total() const { return solid_total_; }
  std::int64_t redistributions() const { return redistributions_; }
  std::int64_t detections() const { return detections_; }
  PhaseTimer& timer() { return timer_; }
  const PhaseTimer& timer() const { return timer_; }

 private:
  void take_initial_state(const InitialFluid& fluid, const InitialSolid& solid);
  void post_maxima(const MotionMaxima& fluid, const MotionMaxima& solid, double request);
  void check_safety(double failure);
  [[noreturn]] void stop_with_diagnosis();
  void stop_where_inverted();
  void check_nothing_is_lost();
  void redistribute_if_due(double squared_displacement, double squared_solid_displacement,
                           const DisplacementBox& displacements);
  BoxesWanted boxes_wanted() const;
  void regather_contact();
  void predict_ahead();
  void predict_what_is_left();
  /// Velocity, density and pressure at the present instant, ready for the sweep.
  void predict_liquid();
  bool density_correction_is_due() const;
  void set_liquid_pressure(std::span<const RowRange> rows);
  void exchange_densities();
  void correct_density();
  bool has_density_diffusion() const;
  void find_density_gradients();
  void sweep_liquid(const SlicedNeighbours& list);
  void account_for_density_diffusion();
  /// Before t = 0 the drop comes to rest; what it starts with is given to it then.
  bool is_relaxing() const { return time_ < 0; }
  void find_shift(double largest_speed);
  void damp_resting_drop();
  void start_drop();
  double next_step_length(double squared_speed) const;
  void sweep_what_needs_no_ghosts();
  void sweep_the_rest();
  /// Whether the solid takes several steps in one of the liquid.
  bool has_substeps() const { return case_.time.solid_substeps > 1; }
  MotionMaxima move_solid_in_substeps(double speed_limit);
  void evaluate_solid(double previous_step);
  void add_gravity(ParticleSet& set, VectorField& acceleration) const;
  void damp_solids();
  void add_forces_on_rigid_body();

  const Communicator& communicator_;
  Case case_;
  DerivedParameters parameters_;
  FluidParticles fluid_;
  SolidParticles solid_;
  std::int64_t fluid_total_ = 0, solid_total_ = 0;
  std::vector<std::int64_t> deflection_probe_, middle_probe_;
  std::vector<std::vector<std::int64_t>> probes_of_solids_;
  std::vector<SolidIds> solids_;
  PointSupports supports_;
  Vector box_low_, box_high_;  // a particle beyond is lost

  std::unique_ptr<SolidStep> solid_step_;
  Distribution distribution_;
  FluidSweep fluid_sweep_;
  GaugePressureStep gauge_;
  ShiftingStep shifting_;
  SurfaceTensionStep surface_tension_;
  ContactStep contact_;
  RigidBodyStep rigid_body_;
  PendingMaximum maxima_;
  std::vector<Column<double>*> fluid_ghosted_, solid_ghosted_, correction_ghosted_;
  std::vector<double> corrected_density_;

  Vector drop_centre_;  // at the very beginning, m
  double time_;
  std::int64_t step_ = 0;
  StepLengths steps_;
  std::span<const double> settled_;  // what move() left under way, once it is known; empty before
  double request_ = 0;
  double squared_drop_speed_ = 0;
  std::optional<SolidStep::Inversion> inversion_;         // the first on this rank
  std::optional<DisplacementBox> contact_displacements_;  // of the liquid, if contact was gathered anew since the lists
  bool wants_displacements_ = false;                      // the drop may move as a whole
  bool is_distributed_ = false;
  bool surface_is_dealt_out_ = false;  // its nodes have counted when particles were
  // At the present instant: by move(), and not lost with a new distribution since.
  bool solid_is_predicted_ = false, liquid_is_predicted_ = false;
  bool detection_is_due_ = true;
  std::int64_t redistributions_ = 0, detections_ = 0;
  PhaseTimer timer_;
};

}  // namespace sphdrop
