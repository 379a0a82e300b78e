#pragma once
// Contact between a distributed drop and a distributed solid (Sec. 2.4): gather, solve at the interface's owner,
// scatter.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "contact/contact_solver.hpp"
#include "contact/contact_surface.hpp"
#include "decomposition/interface_gather.hpp"
#include "diagnostics/contact_record.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"
#include "setup/initial_particles.hpp"
#include "simulation/distribution.hpp"
#include "simulation/solid_bodies.hpp"
#include "wetting/adhesion.hpp"

namespace sphdrop {

/// A force, N/m, and its moment about the origin, N m/m.
struct Load {
  Vector force;
  double moment = 0;
};

/// In a step: start(), receive(), work(), finish(). Only the liquid within reach of the boundary and the boundary
/// within reach of the liquid are gathered.
class ContactStep {
 public:
  /// The boundary is that of `solid`, whose first particle has the global id `first_id`.
  ContactStep(const Communicator& communicator, const Case& input, const InitialSolid& solid, std::int64_t first_id);

  /// Collective, after every redistribution: who may touch whom until the next one.
  void regather(const FluidParticles& fluid, const SolidParticles& solid, const InteractionRange& range);

  /// Sends positions to the owner.
  void start(const FluidParticles& fluid, const SolidParticles& solid);
  /// At the owner: the boundary is as it is now, with no force on it yet.
  void receive();
  /// Collective, apart from a step: the boundary at its owner as it is now.
  void gather_boundary(const SolidParticles& solid);
  /// At the owner: forces at `time`, where Eq 24 takes the step to come, and the impulse they give over the time they
  /// act, `kick`; starts sending them back. All in s. `adhesion`: what else acts on the boundary, where the solid
  /// attracts the liquid; its forces are already among those of boundary_forces().
  void work(double time, double step, double kick, const AdhesionSummary& adhesion);
  /// Adds the accelerations to the liquid's rows and receives the forces on the boundary's; collective if the drop is
  /// rigid.
  void finish(FluidParticles& fluid);
  /// After finish(), one of the two: adds the accelerations to the boundary's rows; or, where the solid takes several
  /// steps in one of the liquid, gives its staggered velocities the whole impulse of forces that act on the liquid for
  /// `kick` (s), so that no momentum is lost. Held over the solid's steps instead, the forces would do work on a
  /// boundary that the liquid does not see move.
  void accelerate_solid(SolidParticles& solid) const;
  void kick_solid(SolidParticles& solid, double kick) const;

  /// The liquid's rows that are within reach of the boundary until the next regather().
  std::span<const std::int32_t> fluid_rows() const { return fluid_rows_; }
  /// Of those rows, of the step last finished: what finish() added to their accelerations, m/s2.
  std::span<const double> acceleration_x() const { return returned_fluid_x_; }
  std::span<const double> acceleration_y() const { return returned_fluid_y_; }
  /// On every rank, of the step last finished; known only where the drop is rigid, which takes the opposite.
  Load load_on_solid() const { return load_on_solid_; }

  int owner() const { return owner_; }
  /// Who sends the owner what, of liquid and boundary.
  const InterfaceGather& fluid_gather() const { return fluid_gather_; }
  const InterfaceGather& solid_gather() const { return solid_gather_; }
  /// At the owner: the part of the boundary that liquid may come near to until the next regather(), as last received,
  /// and the forces on it. If the solid attracts the liquid the part reaches as far as that matters.
  ContactSurface boundary() const { return {solver_.segments(), vertex_x_, vertex_y_}; }
  ContactVertices boundary_forces() { return {vertex_x_, vertex_y_, force_x_, force_y_}; }
  /// At the owner: the force on one solid, N/m, of the step last worked on.
  Vector force_on(const SolidIds& solid) const;
  /// At the owner, of the step last worked on.
  const ContactSummary& summary() const { return summary_; }
  const ContactRecord& record() const { return record_; }
  /// At the owner: the impulse given to the solid up to the instant last worked on, N s/m. The record is half a step
  /// ahead, as velocities are; here the half step is predicted as theirs is.
  Vector impulse() const { return impulse_; }
  /// At the owner: likewise the angular impulse about the origin, N m s/m.
  double angular_impulse() const { return angular_impulse_; }
  /// At the owner: heat made by dampers and drag up to the instant last worked on, J/m.
  double dissipated_energy() const { return dissipated_energy_; }
  /// At the owner: whether an overlap is beyond the limit, and the global id of the deepest particle (-1: none).
  bool overlap_is_too_deep() const { return summary_.overlap_is_too_deep(parameters(1.0)); }
  std::int64_t deepest_particle() const;

  /// Collective: the owner's record and load, the same on every rank.
  std::vector<double> to_numbers() const;
  /// On every rank, before the first regather(). Throws std::invalid_argument where the numbers are not of
  /// to_numbers().
  void from_numbers(std::span<const double> numbers);

 private:
  ContactParameters parameters(double step) const;
  double boundary_reach(const InteractionRange& range) const;
  void find_vertices();
  void share_forces();
  void move_record(int new_owner);
  void accelerate_liquid(FluidParticles& fluid);
  void share_load();

  const Communicator& communicator_;
  ContactParameters parameters_;
  double time_step_stiffness_;  // Eq 24's 0.1; 0 where the springs are fixed
  bool drop_is_rigid_;
  bool is_wetting_;
  double spacing_;
  std::vector<std::int64_t> particle_ids_;  // of the boundary, ascending; elsewhere a particle is its place here
  std::vector<ContactVertex> vertices_;     // of the whole boundary
  bool vertices_are_particles_;             // vertex k is particle k
  std::vector<Segment> segments_;

  int owner_ = 0;
  InterfaceGather fluid_gather_, solid_gather_;
  std::vector<std::int32_t> fluid_rows_, solid_rows_;
  std::vector<double> returned_fluid_x_, returned_fluid_y_, returned_solid_x_, returned_solid_y_;

  Load load_on_solid_;
  std::vector<double> load_numbers_;

  // At the owner.
  ContactSolver solver_;
  ContactSummary summary_;
  ContactRecord record_;
  Vector impulse_, last_force_;
  double staggered_angular_impulse_ = 0, angular_impulse_ = 0, last_moment_ = 0;
  double dissipated_energy_ = 0, last_dissipation_ = 0;
  std::vector<double> fluid_x_, fluid_y_, fluid_mass_, acceleration_x_, acceleration_y_;
  std::vector<ContactVertex> part_;  // the vertices of the part, of particles as gathered
  std::vector<double> vertex_x_, vertex_y_, force_x_, force_y_;
  std::vector<double> fluid_velocity_x_, fluid_velocity_y_, vertex_velocity_x_, vertex_velocity_y_;
  // Where vertices are not particles: those they go with.
  std::vector<double> particle_x_, particle_y_, particle_velocity_x_, particle_velocity_y_, share_x_, share_y_;
};

}  // namespace sphdrop
