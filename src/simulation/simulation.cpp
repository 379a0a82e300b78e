#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnostics/theory.hpp"
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
  energy_of_shift,
  maxima_count
};

SmoothingKernel smoothing_kernel(KernelShape shape, double smoothing_length) {
  if (shape == KernelShape::wendland_c2) return WendlandC2(smoothing_length);
  return CubicSpline(smoothing_length);
}

AnyFluidPairParameters fluid_pair_parameters(const Case::Fluid& fluid, const SmoothingKernel& kernel,
                                             double smoothing_length) {
  return std::visit(
      [&](const auto& chosen) -> AnyFluidPairParameters {
        using Kernel = std::decay_t<decltype(chosen)>;
        if (fluid.viscosity_form == ViscosityForm::physical)
          return FluidPairParameters<Kernel, PhysicalViscosity>{chosen, {fluid.viscosity, smoothing_length}};
        return FluidPairParameters<Kernel, ArtificialViscosity>{
            chosen,
            {fluid.artificial_viscosity_alpha, fluid.artificial_viscosity_beta, fluid.sound_speed, smoothing_length}};
      },
      kernel);
}

template <class Set>
double largest_squared_speed(const Set& set) {
  double largest = 0;
  set.for_each_owned(
      [&](std::size_t row) { largest = std::max(largest, squared_length(set.staggered_velocity.at(row))); });
  return largest;
}

std::vector<std::vector<std::int64_t>> global_polylines(const InitialSolid& solid, std::size_t first_id) {
  std::vector<std::vector<std::int64_t>> polylines;
  for (const auto& polyline : solid.contact_polylines) {
    std::vector<std::int64_t>& ids = polylines.emplace_back();
    for (const std::int32_t index : polyline) ids.push_back(static_cast<std::int64_t>(first_id) + index);
  }
  return polylines;
}

}  // namespace

DerivedParameters::DerivedParameters(const Case& c)
    : smoothing_length(c.resolution.smoothing_ratio * c.resolution.spacing),
      kernel(smoothing_kernel(c.resolution.kernel, smoothing_length)),
      range{2.0 * smoothing_length, c.parallel.skin * c.resolution.spacing},
      fluid_pair(fluid_pair_parameters(c.fluid, kernel, smoothing_length)),
      solid{{CubicSpline(smoothing_length), {}, 1.0 / CubicSpline(smoothing_length).value(c.resolution.spacing)},
            {c.solid.density, c.solid.youngs_modulus, c.solid.poisson_ratio},
            c.solid.deviatoric_trace == DeviatoricTrace::plane_strain ? 1.0 / 3.0 : 0.5,
            c.solid.artificial_stress_coefficient} {
  const bool is_elastic = c.solid.kind == SolidKind::cantilever || c.solid.kind == SolidKind::fixed_fixed_beam;
  const bool has_drop = c.drop.shape != DropShape::none;
  const double solid_speed = solid.material.sound_speed();
  solid.pair.viscosity = {c.solid.artificial_viscosity_alpha, c.solid.artificial_viscosity_beta, solid_speed,
                          smoothing_length};
  time_step.sound_cfl = c.time.sound_cfl;
  time_step.capillary_cfl = c.time.capillary_cfl;
  time_step.viscous_cfl = c.time.viscous_cfl;
  time_step.smoothing_length = smoothing_length;
  // No sound runs through a rigid drop; where none runs through the solid either, the liquid's sets the step, and with
  // it the contact's stiffness (Eq 24).
  const bool heeds_fluid_speed = c.drop.is_liquid() || (has_drop && !is_elastic);
  time_step.sound_speed = std::max(heeds_fluid_speed ? c.fluid.sound_speed : 0.0, is_elastic ? solid_speed : 0.0);
  time_step.density = c.fluid.density;
  const bool has_tension = c.drop.is_liquid() && c.surface_tension.form != SurfaceTensionForm::none;
  time_step.surface_tension = has_tension ? c.surface_tension.coefficient : 0.0;
  time_step.viscosity = c.drop.is_liquid() ? c.fluid.viscosity : 0.0;
  time_step.viscous_time = is_elastic ? c.solid.viscous_time : 0.0;
  damping_rate = c.solid.damping_rate;
  if (is_elastic && c.solid.damping_ratio > 0) {
    const BeamProperties beam{c.solid.youngs_modulus, c.solid.poisson_ratio, c.solid.density, c.solid.length,
                              c.solid.thickness};
    damping_rate += 2.0 * c.solid.damping_ratio *
                    (c.solid.kind == SolidKind::cantilever ? cantilever_angular_frequency(beam)
                                                           : fixed_fixed_angular_frequency(beam));
  }
}

Simulation::Simulation(const Communicator& communicator, const Case& input, const InitialFluid& initial_fluid,
                       const InitialSolid& initial_solid)
    : communicator_(communicator),
      case_(input),
      parameters_(input),
      solid_step_(make_solid_step(input, parameters_.solid, initial_solid,
                                  static_cast<std::int64_t>(initial_fluid.positions.size()))),
      distribution_(communicator, parameters_.range, input.parallel.imbalance_threshold, input.drop.is_rigid(),
                    solid_step_->is_total_lagrangian(),
                    solid_step_->is_total_lagrangian() ? solid_step_->reach() : parameters_.range.list_reach()),
      fluid_sweep_(parameters_.fluid_pair),
      gauge_(communicator, input, initial_fluid.masses),
      shifting_(input, parameters_.kernel),
      surface_tension_(communicator, input, parameters_.kernel),
      contact_(communicator, input, global_polylines(initial_solid, initial_fluid.positions.size())),
      rigid_body_(input, initial_fluid),
      maxima_(communicator),
      drop_centre_(initial_fluid.centre),
      time_(0.0 - input.drop.relaxation_time),
      energy_of_shift_(-infinity) {
  fluid_ghosted_ = fluid_.columns_with(Role::ghosted);
  if (has_density_diffusion()) {
    fluid_ghosted_.push_back(&fluid_.density_gradient.x);
    fluid_ghosted_.push_back(&fluid_.density_gradient.y);
  }
  solid_ghosted_ = solid_step_->ghosted(solid_);
  correction_ghosted_ = {&fluid_.position.x, &fluid_.position.y, &fluid_.density.columns[0]};
  take_initial_state(initial_fluid, initial_solid);
  if (rigid_body_.is_enabled()) rigid_body_.take_places(fluid_);
  timer_.start();
  post_maxima({largest_squared_speed(fluid_)}, {largest_squared_speed(solid_)}, 0);
}

void Simulation::take_initial_state(const InitialFluid& fluid, const InitialSolid& solid) {
  fluid_total_ = static_cast<std::int64_t>(fluid.positions.size());
  solid_total_ = static_cast<std::int64_t>(solid.positions.size());
  // Any share will do: the first redistribution sends every particle home.
  const auto share = [&](std::int64_t total) {
    const std::int64_t rank = communicator_.rank(), ranks = communicator_.size();
    return std::pair(total * rank / ranks, total * (rank + 1) / ranks);
  };
  const auto [fluid_first, fluid_last] = share(fluid_total_);
  fluid_.resize(static_cast<std::size_t>(fluid_last - fluid_first));
  if (fluid_last > fluid_first) fluid_.owned = {{0, static_cast<std::int32_t>(fluid_last - fluid_first)}};
  for (std::int64_t k = fluid_first; k < fluid_last; ++k) {
    const auto row = static_cast<std::size_t>(k - fluid_first), source = static_cast<std::size_t>(k);
    fluid_.id[row] = k;
    fluid_.mass[row] = fluid.masses[source];
    fluid_.position.set(row, fluid.positions[source]);
    fluid_.detection_position.set(row, fluid.positions[source]);
    fluid_.staggered_velocity.set(row, fluid.velocities[source]);
    fluid_.staggered_density[row] = case_.drop.is_rigid() ? case_.drop.density : case_.fluid.density;
  }
  const auto [solid_first, solid_last] = share(solid_total_);
  solid_.resize(static_cast<std::size_t>(solid_last - solid_first));
  if (solid_last > solid_first) solid_.owned = {{0, static_cast<std::int32_t>(solid_last - solid_first)}};
  for (std::int64_t k = solid_first; k < solid_last; ++k) {
    const auto row = static_cast<std::size_t>(k - solid_first), source = static_cast<std::size_t>(k);
    solid_.id[row] = fluid_total_ + k;
    solid_.mass[row] = solid.masses[source];
    solid_.is_fixed[row] = solid.is_fixed[source] ? 1.0 : 0.0;
    solid_.reference_position.set(row, solid.positions[source]);
    solid_.position.set(row, solid.positions[source]);
    solid_.staggered_velocity.set(row, solid.velocities[source]);
    solid_.staggered_density[row] = case_.solid.density;
  }
  for (const std::int32_t index : solid.deflection_probe) deflection_probe_.push_back(fluid_total_ + index);
  for (const std::int32_t index : solid.middle_probe) middle_probe_.push_back(fluid_total_ + index);

  box_low_ = {infinity, infinity};
  box_high_ = {-infinity, -infinity};
  for (const auto* positions : {&fluid.positions, &solid.positions})
    for (const Vector& p : *positions) {
      box_low_ = {std::min(box_low_.x, p.x), std::min(box_low_.y, p.y)};
      box_high_ = {std::max(box_high_.x, p.x), std::max(box_high_.y, p.y)};
    }
  const Vector margin{case_.safety.domain_margin, case_.safety.domain_margin};
  box_low_ -= margin;
  box_high_ += margin;
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

  double detection_displacement = 0;
  fluid_.for_each_owned([&](std::size_t row) {
    detection_displacement =
        std::max(detection_displacement, squared_length(fluid_.position.at(row) - fluid_.detection_position.at(row)));
  });
  maxima_.finish();
  settled_ = {};
  post_maxima({largest_squared_speed(fluid_), 0, detection_displacement}, {largest_squared_speed(solid_)}, 0);
}

SavedSimulation Simulation::save() const {
  return {StoredParticles("fluid", fluid_, fluid_total_),
          StoredParticles("solid", solid_, solid_total_),
          {clock_numbers({time_, step_, steps_.previous}),
           {"surface", "-",
            "surface tension: whether the curves were detected, length and base that came with detections (m)",
            surface_tension_.to_numbers()},
           {"contact", "-", "record of the contact, its heat and the load of the last step", contact_.to_numbers()},
           {"rigid_body", "-", "the drop as a rigid body", rigid_body_.to_numbers()},
           {"gauge_pressure", "-",
            "the drop's gauge pressure and what it tends to (Pa), area within the curves (m2), energy by its changes "
            "(J/m)",
            gauge_.to_numbers()},
           {"shifting", "J/m", "energy that shifts have added", shifting_.to_numbers()}}};
}

void Simulation::settle() {
  if (!settled_.empty()) return;
  settled_ = maxima_.finish();
  gauge_.finish();
  if (settled_[energy_of_shift] > -infinity) shifting_.add_work(settled_[energy_of_shift]);
  timer_.lap(Phase::communication);
  request_ = settled_[requested];
  check_safety(settled_[failure]);
}

void Simulation::evaluate() {
  settle();
  const std::span<const double> maxima = std::exchange(settled_, {});
  detection_is_due_ =
      surface_tension_.is_enabled() &&
      (step_ == 0 || maxima[squared_detection_displacement] >= surface_tension_.largest_squared_displacement());
  const double squared_speed_now = maxima[squared_speed], squared_liquid_speed_now = maxima[squared_liquid_speed];
  redistribute_if_due(maxima[squared_displacement], maxima[squared_solid_displacement]);

  solid_step_->predict(solid_, steps_.previous);
  if (rigid_body_.is_enabled())
    rigid_body_.predict(fluid_, steps_.previous);
  else
    predict_liquid();
  timer_.lap(Phase::update);

  start_exchange(distribution_.fluid_halo(), fluid_ghosted_);
  start_exchange(distribution_.solid_halo(), solid_ghosted_);
  if (detection_is_due_) {
    surface_tension_.detect(fluid_, solid_, distribution_, contact_, gauge_.pressure());
    ++detections_;
    timer_.lap(Phase::surface_tension);
  }
  if (surface_tension_.is_enabled()) surface_tension_.start(fluid_);
  contact_.start(fluid_, solid_);
  timer_.lap(Phase::communication);

  steps_.next = next_step_length(squared_speed_now);
  sweep_what_needs_no_ghosts();
  contact_.receive();
  timer_.lap(Phase::contact);
  if (surface_tension_.is_enabled()) surface_tension_.work(contact_, gauge_.pressure());
  if (gauge_.is_enabled()) gauge_.start(fluid_, surface_tension_.enclosed_area());
  timer_.lap(Phase::surface_tension);
  contact_.work(time_, steps_.next, steps_.kick(), surface_tension_.adhesion());
  timer_.lap(Phase::contact);
  finish_exchange(distribution_.fluid_halo(), fluid_ghosted_);
  finish_exchange(distribution_.solid_halo(), solid_ghosted_);
  timer_.lap(Phase::communication);
  sweep_the_rest();

  if (surface_tension_.is_enabled()) surface_tension_.finish(fluid_);
  contact_.finish(fluid_, solid_);
  timer_.lap(Phase::communication);
  if (is_relaxing())
    damp_resting_drop();
  else
    add_gravity();
  if (has_density_diffusion()) account_for_density_diffusion();
  if (shifting_.is_due(step_)) find_shift(std::sqrt(squared_liquid_speed_now));
  if (rigid_body_.is_enabled()) add_forces_on_rigid_body();
  if (parameters_.damping_rate > 0) add_mass_proportional_damping(solid_, parameters_.damping_rate);
}

void Simulation::move(double request) {
  const double limit = case_.safety.speed_limit;
  const bool was_relaxing = is_relaxing();
  shifting_.apply(fluid_, is_relaxing() ? Vector{} : Vector{case_.gravity.x, case_.gravity.y});
  MotionMaxima fluid =
      rigid_body_.is_enabled() ? rigid_body_.move(fluid_, steps_, limit) : kick_and_drift(fluid_, steps_, limit);
  const MotionMaxima solid = solid_step_->move(solid_, steps_, limit);
  time_ += steps_.next;
  ++step_;
  steps_.previous = steps_.next;
  if (was_relaxing && !is_relaxing()) {
    start_drop();
    fluid = motion_maxima(fluid_, limit);
  }
  post_maxima(fluid, solid, request);
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
  const bool unsound = fluid.beyond_limit || solid.beyond_limit || solid_step_->inversion(solid_).has_value();
  mine[failure] = unsound || too_deep ? 1.0 : 0.0;
  mine[requested] = request;
  mine[energy_of_shift] = std::exchange(energy_of_shift_, -infinity);  // a number on one rank
  maxima_.start(mine);
}

void Simulation::redistribute_if_due(double largest_squared_displacement, double solid_squared_displacement) {
  const double allowed = parameters_.range.largest_displacement();
  const std::int64_t interval = case_.parallel.repartition_interval;
  const bool forced = interval > 0 && step_ % interval == 0;
  if (is_distributed_ && !forced && largest_squared_displacement <= allowed * allowed) {
    // Such a solid stays with its ranks, but the drop may come upon another part of it.
    if (solid_squared_displacement > allowed * allowed && fluid_total_ > 0) {
      contact_.regather(fluid_, solid_, parameters_.range);
      solid_.list_position.take(solid_.position);
      timer_.lap(Phase::redistribution);
    }
    return;
  }
  distribution_.redistribute(fluid_, solid_, forced);
  check_nothing_is_lost();
  corrected_density_.resize(fluid_.size() + column_padding);
  fluid_sweep_.resize(fluid_);
  solid_step_->relist(solid_, distribution_);
  contact_.regather(fluid_, solid_, parameters_.range);
  if (surface_tension_.is_enabled() && is_distributed_) surface_tension_.regather(fluid_, contact_);
  if (surface_tension_.is_enabled() && !is_distributed_) surface_tension_.recover(fluid_, distribution_, contact_);
  is_distributed_ = true;
  ++redistributions_;
  timer_.lap(Phase::redistribution);
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

void Simulation::add_gravity() {
  const Vector g{case_.gravity.x, case_.gravity.y};
  if (g == Vector{}) return;
  const auto add = [&](auto& set) {
    set.for_each_owned([&](std::size_t row) {
      set.acceleration.x[row] += g.x;
      set.acceleration.y[row] += g.y;
    });
  };
  if (!rigid_body_.is_enabled()) add(fluid_);
  add(solid_);
}

void Simulation::add_forces_on_rigid_body() {
  const Load reaction = contact_.load_on_solid();
  rigid_body_.accelerate(-reaction.force, -reaction.moment, {case_.gravity.x, case_.gravity.y});
}

}  // namespace sphdrop
