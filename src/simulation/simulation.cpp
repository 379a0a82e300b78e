#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/particle_transport.hpp"
#include "solid/mass_proportional_damping.hpp"

namespace sphdrop {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// What one reduction a step brings to all ranks.
enum Maximum : std::size_t {
  squared_speed,
  squared_liquid_speed,
  squared_displacement,
  squared_solid_displacement,  // only of a solid that is dealt out by its undeformed body
  squared_detection_displacement,
  failure,
  requested,
  displacements,                                // of the liquid: a box
  detection_displacements = displacements + 4,  // likewise
  maxima_count = detection_displacements + 4
};

void put_box(std::span<double> maxima, const DisplacementBox& box) {
  maxima[0] = -box.low_x;
  maxima[1] = box.high_x;
  maxima[2] = -box.low_y;
  maxima[3] = box.high_y;
}

DisplacementBox box_at(std::span<const double> maxima) {
  return {-maxima[0], maxima[1], -maxima[2], maxima[3]};
}

template <class Set>
double largest_squared_speed(const Set& set) {
  double largest = 0;
  set.for_each_owned(
      [&](std::size_t row) { largest = std::max(largest, squared_length(set.staggered_velocity.at(row))); });
  return largest;
}

}  // namespace

Simulation::Simulation(const Communicator& communicator, const Case& input, const InitialFluid& initial_fluid,
                       const InitialSolid& initial_solid)
    : communicator_(communicator),
      case_(input),
      parameters_(input),
      solid_step_(make_solid_step(input, parameters_.solid, initial_solid, initial_fluid.total)),
      distribution_(communicator, parameters_.range,
                    partition_cell_edge(input, parameters_.range, solid_step_->is_total_lagrangian(),
                                        static_cast<std::size_t>(initial_fluid.total),
                                        static_cast<std::size_t>(initial_solid.total()), communicator.size()),
                    input.parallel.imbalance_threshold, input.drop.is_rigid(), solid_step_->is_total_lagrangian(),
                    solid_step_->is_total_lagrangian() ? solid_step_->reach() : parameters_.range.list_reach()),
      fluid_sweep_(parameters_.fluid_pair),
      gauge_(communicator, input, initial_fluid),
      shifting_(communicator, input, parameters_.kernel),
      surface_tension_(communicator, input, parameters_.kernel),
      contact_(communicator, input, initial_solid, initial_fluid.total),
      rigid_body_(input, initial_fluid),
      maxima_(communicator),
      drop_centre_(initial_fluid.centre),
      time_(0.0 - input.drop.relaxation_time),
      timer_(communicator) {
  fluid_ghosted_ = fluid_.columns_with(Role::ghosted);
  if (has_density_diffusion()) {
    fluid_ghosted_.push_back(&fluid_.density_gradient.x);
    fluid_ghosted_.push_back(&fluid_.density_gradient.y);
  } else {
    fluid_.density_gradient.leave_out();
    fluid_.density_diffusion.leave_out();
  }
  if (!shifting_.is_enabled()) {
    fluid_.surface_orientation.leave_out();
    fluid_.shift_energy.leave_out();
  }
  if (!gauge_.is_enabled()) fluid_.gauge_energy.leave_out();
  if (!rigid_body_.is_enabled()) fluid_.body_offset.leave_out();
  solid_ghosted_ = solid_step_->ghosted(solid_);
  correction_ghosted_ = {&fluid_.position.x, &fluid_.position.y, &fluid_.density.columns[0]};
  take_initial_state(initial_fluid, initial_solid);
  if (rigid_body_.is_enabled()) rigid_body_.take_places(fluid_);
  timer_.start();
  post_maxima({largest_squared_speed(fluid_)}, {largest_squared_speed(solid_)}, 0);
  timer_.lap(Phase::communication);
}

void Simulation::take_initial_state(const InitialFluid& fluid, const InitialSolid& solid) {
  fluid_total_ = fluid.total;
  solid_total_ = solid.total();
  // Any share will do: the first redistribution sends every particle home.
  const Share share{communicator_.rank(), communicator_.size()};
  const auto [fluid_first, fluid_last] = share.of(fluid_total_);
  assert(fluid.ids().contains(share.of(fluid_total_)));
  fluid_.resize(static_cast<std::size_t>(fluid_last - fluid_first));
  if (fluid_last > fluid_first) fluid_.owned = {{0, static_cast<std::int32_t>(fluid_last - fluid_first)}};
  for (std::int64_t k = fluid_first; k < fluid_last; ++k) {
    const auto row = static_cast<std::size_t>(k - fluid_first), source = static_cast<std::size_t>(k - fluid.first_id);
    fluid_.id[row] = k;
    fluid_.mass[row] = fluid.masses[source];
    fluid_.position.set(row, fluid.positions[source]);
    fluid_.detection_position.set(row, fluid.positions[source]);
    fluid_.staggered_velocity.set(row, fluid.velocities[source]);
    fluid_.staggered_density[row] = case_.drop.is_rigid() ? case_.drop.density : case_.fluid.density;
  }
  const auto [solid_first, solid_last] = share.of(solid_total_);
  assert(solid.indices().contains(share.of(solid_total_)));
  solid_.resize(static_cast<std::size_t>(solid_last - solid_first));
  if (solid_last > solid_first) solid_.owned = {{0, static_cast<std::int32_t>(solid_last - solid_first)}};
  solids_ = solid_bodies(solid, fluid_total_);
  std::size_t which = 0;
  for (std::int64_t k = solid_first; k < solid_last; ++k) {
    const auto row = static_cast<std::size_t>(k - solid_first), source = static_cast<std::size_t>(k - solid.before);
    solid_.id[row] = fluid_total_ + k;
    solid_.mass[row] = solid.masses[source];
    solid_.is_fixed[row] = solid.is_fixed[source] ? 1.0 : 0.0;
    solid_.reference_position.set(row, solid.positions[source]);
    solid_.position.set(row, solid.positions[source]);
    solid_.staggered_velocity.set(row, solid.velocities[source]);
    while (solids_[which].end <= fluid_total_ + k) ++which;
    // Of what is rigid the sums would make a pressure out of another density.
    const Case::Solid& mine = case_.solid_at(which);
    solid_.staggered_density[row] = mine.is_elastic() ? mine.density : case_.first_elastic_solid().density;
  }
  supports_ = PointSupports(solid, fluid_total_);
  for (const InitialSolid::Body& body : solid.bodies) {
    probes_of_solids_.emplace_back();
    for (const std::int32_t index : body.deflection_probe) probes_of_solids_.back().push_back(fluid_total_ + index);
  }
  for (const std::int32_t index : solid.deflection_probe) deflection_probe_.push_back(fluid_total_ + index);
  for (const std::int32_t index : solid.middle_probe) middle_probe_.push_back(fluid_total_ + index);

  Box box = fluid.bounds;
  box.include(solid.bounds);
  for (const Vector& p : solid.positions) box.include(p);
  box = box.grown_by(case_.safety.domain_margin);
  box_low_ = box.low;
  box_high_ = box.high;
}

void Simulation::restore(const Checkpoint& checkpoint) {
  const auto expect_rows = [&](const char* name, std::int64_t expected) {
    const std::int64_t rows = checkpoint.table(name).total_rows;
    if (rows != expected)
      throw CheckpointError(fmt::format("{} is of another set-up: it has {} rows of {}, the case makes {}",
                                        checkpoint.path.string(), rows, name, expected));
  };
  expect_rows("fluid", fluid_total_);
  expect_rows("solid", solid_total_);
  restore_particles(checkpoint, "fluid", fluid_);
  restore_particles(checkpoint, "solid", solid_);
  try {
    const Clock clock = clock_of(checkpoint.numbers_of("clock"));
    time_ = clock.time;
    step_ = clock.step;
    steps_.previous = clock.previous_step;
    surface_tension_.from_numbers(checkpoint.numbers_of("surface"));
    contact_.from_numbers(checkpoint.numbers_of("contact"));
    rigid_body_.from_numbers(checkpoint.numbers_of("rigid_body"));
    gauge_.from_numbers(checkpoint.numbers_of("gauge_pressure"));
    shifting_.from_numbers(checkpoint.numbers_of("shifting"));
  } catch (const std::invalid_argument& error) {
    throw CheckpointError(fmt::format("{}: {}", checkpoint.path.string(), error.what()));
  }
  const SavedSimulation again = save();
  if (communicator_.sum(again.hash()) != checkpoint.header.state_hash)
    throw CheckpointError(fmt::format("{}: the state read is not the one that was written", checkpoint.path.string()));

  const MotionMaxima motion = motion_maxima(fluid_, infinity, boxes_wanted());
  maxima_.finish();
  settled_ = {};
  timer_.start();
  post_maxima({motion.squared_speed, 0, motion.squared_detection_displacement, {}, motion.detection_displacements},
              {largest_squared_speed(solid_)}, 0);
}

SavedSimulation Simulation::save() const {
  return {
      StoredParticles("fluid", fluid_, fluid_total_),
      StoredParticles("solid", solid_, solid_total_),
      {clock_numbers({time_, step_, steps_.previous}),
       {"surface", "-",
        "surface tension: whether the curves were detected, length and base that came with detections (m), likewise "
        "energy of the gauge (J/m), energy that came with sharing the forces (J/m)",
        surface_tension_.to_numbers()},
       {"contact", "-", "record of the contact, its heat and the load of the last step", contact_.to_numbers()},
       {"rigid_body", "-",
        "the drop as a rigid body, none if it is liquid: mass (kg/m), moment of inertia (kg m2/m), centre x, y (m), "
        "angle (rad); half a step back velocity x, y (m/s), spin (rad/s); acceleration x, y (m/s2), angular "
        "(rad/s2); velocity x, y (m/s), spin (rad/s)",
        rigid_body_.to_numbers()},
       {"gauge_pressure", "-",
        "the drop's gauge pressure and what it tends to (Pa), area within the curves (m2), energy of the surface by "
        "its changes (J/m)",
        gauge_.to_numbers()},
       {"shifting", "J/m", "energy that shifts have added", shifting_.to_numbers()}}};
}

double Simulation::largest_drop_speed() const {
  return std::sqrt(squared_drop_speed_);
}

void Simulation::settle() {
  if (!settled_.empty()) return;
  settled_ = maxima_.finish();
  gauge_.finish();
  timer_.lap(Phase::communication);
  request_ = settled_[requested];
  check_safety(settled_[failure]);
}

void Simulation::evaluate() {
  settle();
  const std::span<const double> maxima = std::exchange(settled_, {});
  detection_is_due_ =
      surface_tension_.is_enabled() &&
      (step_ == 0 || surface_tension_.detection_is_due(maxima[squared_detection_displacement],
                                                       box_at(maxima.subspan(detection_displacements, 4))));
  const double squared_speed_now = maxima[squared_speed], squared_liquid_speed_now = maxima[squared_liquid_speed];
  squared_drop_speed_ = squared_liquid_speed_now;
  redistribute_if_due(maxima[squared_displacement], maxima[squared_solid_displacement],
                      box_at(maxima.subspan(displacements, 4)));

  predict_what_is_left();

  start_exchange(distribution_.fluid_halo(), fluid_ghosted_);
  start_exchange(distribution_.solid_halo(), solid_ghosted_);
  if (detection_is_due_) {
    timer_.lap(Phase::communication);
    surface_tension_.detect(fluid_, solid_, distribution_, contact_, gauge_.pressure());
    ++detections_;
    timer_.lap(Phase::detection);
  }
  if (surface_tension_.is_enabled()) surface_tension_.start(fluid_);
  contact_.start(fluid_, solid_);
  timer_.lap(Phase::communication);

  steps_.next = next_step_length(squared_speed_now);
  sweep_what_needs_no_ghosts();
  contact_.receive();
  if (surface_tension_.is_enabled()) surface_tension_.receive();
  timer_.lap(Phase::communication);
  if (surface_tension_.is_enabled()) surface_tension_.work(contact_, gauge_.pressure());
  if (gauge_.is_enabled()) gauge_.start(fluid_, surface_tension_);
  timer_.lap(Phase::surface_tension);
  contact_.work(time_, steps_.next, steps_.kick(), surface_tension_.adhesion());
  timer_.lap(Phase::contact);
  finish_exchange(distribution_.fluid_halo(), fluid_ghosted_);
  finish_exchange(distribution_.solid_halo(), solid_ghosted_);
  timer_.lap(Phase::communication);
  sweep_the_rest();

  if (surface_tension_.is_enabled()) surface_tension_.finish(fluid_, steps_.kick());
  contact_.finish(fluid_);
  if (!has_substeps()) contact_.accelerate_solid(solid_);
  timer_.lap(Phase::communication);
  if (is_relaxing()) {
    damp_resting_drop();
  } else {
    if (!rigid_body_.is_enabled()) add_gravity(fluid_, fluid_.acceleration);
    add_gravity(solid_, solid_.acceleration);
  }
  if (has_density_diffusion()) account_for_density_diffusion();
  if (shifting_.is_due(step_)) find_shift(std::sqrt(squared_liquid_speed_now));
  if (rigid_body_.is_enabled()) add_forces_on_rigid_body();
  damp_solids();
}

void Simulation::damp_solids() {
  for (const SolidIds& ids : solids_)
    if (const double rate = parameters_.damping_rate[ids.solid]; rate > 0)
      for_each_owned_of(solid_, ids, [&](std::size_t row) { add_mass_proportional_damping(solid_, row, rate); });
}

void Simulation::move(double request) {
  const double limit = case_.safety.speed_limit;
  const bool was_relaxing = is_relaxing();
  shifting_.apply(fluid_, is_relaxing() ? Vector{} : Vector{case_.gravity.x, case_.gravity.y}, steps_.kick());
  MotionMaxima fluid = rigid_body_.is_enabled() ? rigid_body_.move(fluid_, steps_, limit)
                                                : kick_and_drift(fluid_, steps_, limit, boxes_wanted());
  supports_.stop(solid_);
  const MotionMaxima solid = has_substeps() ? move_solid_in_substeps(limit) : solid_step_->move(solid_, steps_, limit);
  time_ += steps_.next;
  ++step_;
  steps_.previous = steps_.next;
  if (was_relaxing && !is_relaxing()) {
    start_drop();
    fluid = motion_maxima(fluid_, limit, boxes_wanted());
  }
  post_maxima(fluid, solid, request);
  predict_ahead();
  timer_.lap(Phase::update);
}

// While the reduction is under way, what needs nothing of other ranks and nothing of the reduction.
void Simulation::predict_ahead() {
  solid_step_->predict(solid_, steps_.previous);
  solid_is_predicted_ = true;
  if (rigid_body_.is_enabled() || gauge_.is_enabled() || has_density_diffusion() || density_correction_is_due()) return;
  predict_liquid();
  liquid_is_predicted_ = true;
}

void Simulation::predict_what_is_left() {
  if (!std::exchange(solid_is_predicted_, false)) solid_step_->predict(solid_, steps_.previous);
  const bool liquid_is_left = !std::exchange(liquid_is_predicted_, false);
  if (rigid_body_.is_enabled())
    rigid_body_.predict(fluid_, steps_.previous);
  else if (liquid_is_left)
    predict_liquid();
  timer_.lap(Phase::update);
}

void Simulation::post_maxima(const MotionMaxima& fluid, const MotionMaxima& solid, double request) {
  std::array<double, maxima_count> mine{};
  mine[squared_speed] = std::max(fluid.squared_speed, solid.squared_speed);
  mine[squared_liquid_speed] = fluid.squared_speed;
  if (solid_step_->is_total_lagrangian()) {
    mine[squared_displacement] = fluid.squared_displacement;
    mine[squared_solid_displacement] = solid.squared_displacement;
  } else {
    mine[squared_displacement] = std::max(fluid.squared_displacement, solid.squared_displacement);
  }
  mine[squared_detection_displacement] = fluid.squared_detection_displacement;
  const bool too_deep = contact_.owner() == communicator_.rank() && contact_.overlap_is_too_deep();
  if (!inversion_) inversion_ = solid_step_->inversion(solid_);
  const bool unsound = fluid.beyond_limit || solid.beyond_limit || inversion_.has_value();
  mine[failure] = unsound || too_deep ? 1.0 : 0.0;
  mine[requested] = request;
  put_box(std::span(mine).subspan(displacements, 4), fluid.displacements);
  put_box(std::span(mine).subspan(detection_displacements, 4), fluid.detection_displacements);
  surface_tension_.book_sharing_work();
  shifting_.book_work();
  maxima_.start(mine);
}

double Simulation::next_step_length(double squared_speed_now) const {
  const double step =
      case_.time.step > 0 ? case_.time.step : stable_time_step(parameters_.time_step, std::sqrt(squared_speed_now));
  // The drop starts at t = 0 sharp, after steps that are nearly equal: contact's stiffness depends on them (Eq 24).
  return is_relaxing() ? -time_ / std::ceil(-time_ / step) : step;
}

void Simulation::sweep_what_needs_no_ghosts() {
  sweep_liquid(distribution_.inner_fluid());
  timer_.lap(Phase::fluid_sweep);
  solid_step_->sweep_inner(solid_, distribution_);
  timer_.lap(Phase::solid_sweep);
}

void Simulation::sweep_the_rest() {
  set_liquid_pressure(fluid_.ghosts);
  fluid_sweep_.pack(fluid_, fluid_.ghosts, gauge_.pressure());
  sweep_liquid(distribution_.border_fluid());
  timer_.lap(Phase::fluid_sweep);
  solid_step_->sweep_rest(solid_, distribution_);
  timer_.lap(Phase::solid_sweep);
}

void Simulation::add_gravity(ParticleSet& set, VectorField& acceleration) const {
  const Vector g{case_.gravity.x, case_.gravity.y};
  if (g == Vector{}) return;
  set.for_each_owned([&](std::size_t row) {
    acceleration.x[row] += g.x;
    acceleration.y[row] += g.y;
  });
}

void Simulation::add_forces_on_rigid_body() {
  const Load reaction = contact_.load_on_solid();
  rigid_body_.accelerate(-reaction.force, -reaction.moment, {case_.gravity.x, case_.gravity.y});
}

}  // namespace sphdrop
