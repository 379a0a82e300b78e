#include "simulation/recorder.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "diagnostics/frequency.hpp"
#include "diagnostics/theory.hpp"
#include "simulation/rank_traffic.hpp"
#include "simulation/snapshot_table.hpp"
#include "time_integration/due_time.hpp"

namespace sphdrop {

namespace {

std::vector<HistoryColumn> history_columns(std::size_t solids) {
  std::vector<HistoryColumn> columns;
  for (const ObservedQuantity& q : observed_quantities())
    columns.push_back({std::string(q.name), std::string(q.unit), std::string(q.description)});
  for (std::size_t k = 1; k <= solids && solids > 1; ++k)
    for (const SolidQuantity& q : solid_quantities())
      columns.push_back(
          {fmt::format("{}_{}", q.name, k), std::string(q.unit), fmt::format("solid {}: {}", k, q.description)});
  return columns;
}

// Pressures of the order rho v^2 change the density by the square of this.
constexpr double nearly_incompressible_mach_number = 0.1;

std::optional<double> if_known(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// The most memory that this process has held at a time, bytes; 0: unknown.
double peak_memory() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * static_cast<double>(usage.ru_maxrss) : 0.0;
}

double elapsed(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

Recorder::Recorder(Simulation& simulation, const RecorderOptions& options, const Checkpoint* checkpoint)
    : simulation_(simulation),
      options_(options),
      snapshots_(simulation.communicator(), options.directory,
                 checkpoint == nullptr ? std::numeric_limits<double>::infinity() : checkpoint->header.time),
      progress_(stderr, simulation.communicator().rank() == 0 ? options.progress : Progress::Mode::quiet,
                options.end_time),
      first_step_(simulation.step()),
      start_(std::chrono::steady_clock::now()) {
  if (checkpoint != nullptr) restore(*checkpoint);
  const std::vector<HistoryColumn> columns = history_columns(simulation.input().solid_count());
  on_first_rank([&] {
    history_.emplace(checkpoint == nullptr ? HistoryWriter::create(options_.directory, columns)
                                           : HistoryWriter::resume(options_.directory, columns, simulation_.time()));
  });
  simulation.timer().lap(Phase::output);
}

std::vector<CheckpointNumbers> Recorder::save() const {
  std::vector<double> first;
  if (first_)
    for (const ObservedQuantity& q : observed_quantities()) first.push_back((*first_).*q.value);
  const Case::Output& output = simulation_.input().output;
  return {{"first_observation", "-", "the history's first row, if it is written; columns as there", std::move(first)},
          {"extremes", "-", "widest drop, deepest beam (times in s, values in m) and rebound so far",
           extremes_.to_numbers()},
          {"ringing_times", "s", "times of the history's rows since the last contact", ringing_times_},
          {"ringing_deflections", "m", "deflections at these times", ringing_deflections_},
          {"largest_mach_number",
           "-",
           "when the liquid was fastest (s), and that speed over fluid.sound_speed",
           {largest_mach_number_.time, largest_mach_number_.value}},
          {"due_times",
           "s",
           "next row, next snapshot; the intervals of both when this was written",
           {next_row_, next_snapshot_, output.history_interval, output.snapshot_interval}}};
}

void Recorder::restore(const Checkpoint& checkpoint) {
  const std::vector<double>& first = checkpoint.numbers_of("first_observation");
  const std::span<const ObservedQuantity> quantities = observed_quantities();
  if (!first.empty()) {
    if (first.size() != quantities.size())
      throw CheckpointError(fmt::format("{} has {} watched quantities, not {}: it was written by another version",
                                        checkpoint.path.string(), first.size(), quantities.size()));
    first_.emplace();
    for (std::size_t k = 0; k < first.size(); ++k) (*first_).*quantities[k].value = first[k];
  }
  try {
    extremes_ = Extremes::from_numbers(checkpoint.numbers_of("extremes"));
  } catch (const std::invalid_argument& error) {
    throw CheckpointError(fmt::format("{}: {}", checkpoint.path.string(), error.what()));
  }
  // One written before it was watched does not have it.
  for (const CheckpointNumbers& numbers : checkpoint.numbers)
    if (numbers.name == "largest_mach_number" && numbers.values.size() == 2)
      largest_mach_number_ = {numbers.values[0], numbers.values[1]};
  ringing_times_ = checkpoint.numbers_of("ringing_times");
  ringing_deflections_ = checkpoint.numbers_of("ringing_deflections");
  const std::vector<double>& due = checkpoint.numbers_of("due_times");
  if (due.size() != 4) throw CheckpointError(fmt::format("{}: /run/due_times is not whole", checkpoint.path.string()));
  // Another interval than before begins at its next multiple.
  const Case::Output& output = simulation_.input().output;
  const double now = simulation_.time();
  const auto due_again = [&](double stored, double old_interval, double interval) {
    if (interval == old_interval) return stored;
    return std::max(0.0, next_multiple(now, interval));
  };
  next_row_ = due_again(due[0], due[2], output.history_interval);
  next_snapshot_ = due_again(due[1], due[3], output.snapshot_interval);
}

void Recorder::synchronise() {
  on_first_rank([&] { history_->synchronise(); });
}

void Recorder::interrupt() {
  on_first_rank([&] { history_->close(); });
  progress_.finish();
}

template <class F>
void Recorder::on_first_rank(F&& f) {
  std::string error;
  if (simulation_.communicator().rank() == 0) {
    try {
      f();
    } catch (const std::exception& e) {
      error = e.what();
    }
  }
  simulation_.communicator().broadcast(error, 0);
  if (!error.empty()) throw HistoryError(error);
}

// The speed is what the time step rests on, which every rank knows at every step.
void Recorder::watch_speed() {
  const Case& c = simulation_.input();
  if (!c.drop.is_liquid()) return;
  const double speed = simulation_.largest_drop_speed(), number = speed / c.fluid.sound_speed;
  if (number <= largest_mach_number_.value) return;
  const bool is_known = largest_mach_number_.value > nearly_incompressible_mach_number;
  largest_mach_number_ = {simulation_.time(), number};
  // That it starts too fast has been said of the case.
  if (number <= nearly_incompressible_mach_number || is_known || simulation_.step() == 0) return;
  if (simulation_.communicator().rank() != 0) return;
  progress_.finish();
  fmt::print(stderr,
             "warning: step {}, t = {:.6g} s: a particle of the liquid moves at {:.4g} m/s, more than {} of "
             "fluid.sound_speed = {:.6g} m/s: there the liquid is compressed by about 1 %. If it is more than a few "
             "particles thrown off, run again with fluid.sound_speed = {:.3g} m/s, 50 times that speed\n",
             simulation_.step(), simulation_.time(), speed, nearly_incompressible_mach_number, c.fluid.sound_speed,
             50 * speed);
}

void Recorder::observe() {
  watch_speed();
  const double time = simulation_.time();
  const Case& c = simulation_.input();
  if (time < next_row_ && time < next_snapshot_) return;
  simulation_.timer().lap(Phase::update);
  if (time >= next_row_) {
    write_row();
    next_row_ = next_multiple(time, c.output.history_interval);
  }
  if (time >= next_snapshot_) {
    write_snapshot();
    next_snapshot_ = next_multiple(time, c.output.snapshot_interval);
  }
  simulation_.timer().lap(Phase::output);
}

std::uint64_t Recorder::finish() {
  if (!last_ || last_->step != static_cast<double>(simulation_.step())) write_row();
  if (last_snapshot_step_ != simulation_.step()) write_snapshot();
  on_first_rank([&] { history_->close(); });
  progress_.finish();
  return hash_;
}

void Recorder::write_row() {
  const Observation o = sphdrop::observe(simulation_, first_ ? first_->total : 0.0);
  if (!first_) {
    first_ = o;
    first_->unaccounted = 0.0;
  }
  last_ = o;
  last_->unaccounted = last_->unaccounted - (first_->step == o.step ? o.unaccounted : 0.0);
  // A drop that wets the solid touches it as long as it has a base.
  const double touch = std::isfinite(o.base_width) ? (o.base_width > 0 ? 1.0 : 0.0) : o.contact_count;
  const auto touching = static_cast<std::int64_t>(touch);
  if (std::isfinite(o.drop_width) || std::isfinite(o.deflection))
    extremes_.add(o.time, std::isfinite(o.drop_width) ? o.drop_width : 0.0,
                  std::isfinite(o.deflection) ? o.deflection : 0.0, touching,
                  std::isfinite(o.drop_velocity_y) ? o.drop_velocity_y : 0.0);
  if (touching > 0) {
    ringing_times_.clear();
    ringing_deflections_.clear();
  } else if (std::isfinite(o.deflection)) {
    ringing_times_.push_back(o.time);
    ringing_deflections_.push_back(o.deflection);
  }
  on_first_rank([&] {
    std::vector<double> values;
    for (const ObservedQuantity& q : observed_quantities()) values.push_back((*last_).*q.value);
    for (const SolidObservation& solid : last_->solids)
      for (const SolidQuantity& q : solid_quantities()) values.push_back(solid.*q.value);
    history_->append(values);
  });
  const double kinetic = first_->kinetic_fluid + first_->kinetic_solid;
  ProgressSample sample;
  sample.time = o.time;
  sample.step = simulation_.step();
  sample.wall_seconds = elapsed(start_);
  sample.drop_width = if_known(o.drop_width);
  sample.deflection = if_known(o.deflection);
  if (kinetic > 0) sample.energy_error = last_->unaccounted / kinetic;
  progress_.update(sample);
}

// The period at which the beam rings once nothing touches it any more; empty where it was not watched long enough.
std::optional<double> Recorder::ringing_period() const {
  try {
    return 1.0 / frequency_by_zero_crossings(ringing_times_, ringing_deflections_).frequency;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

void Recorder::write_snapshot() {
  hash_ = state_hash(simulation_);  // which completes what is written
  const SnapshotTable table(simulation_.fluid(), simulation_.solid());
  const SnapshotHeader header{simulation_.time(), simulation_.step(), hash_, simulation_.input().name,
                              options_.version};
  snapshots_.write(header, table.rows(simulation_.fluid_total() + simulation_.solid_total()), table.columns());
  last_snapshot_step_ = simulation_.step();
}

RunSummary Recorder::summary() const {
  const Case& c = simulation_.input();
  const Communicator& communicator = simulation_.communicator();
  RunSummary r;
  r.simulated_time = simulation_.time();
  r.steps = simulation_.step();
  r.first_step = first_step_;

  // The contact's record lives at its owner.
  std::vector<double> record;
  if (communicator.rank() == simulation_.contact().owner()) record = simulation_.contact().record().to_numbers();
  communicator.broadcast(record, simulation_.contact().owner());
  const bool has_drop = simulation_.fluid_total() > 0, has_solid = simulation_.solid_total() > 0;
  const bool is_beam = c.has_elastic_solid();
  if (has_drop && has_solid) r.contact = contact_summary(ContactRecord::from_numbers(record));

  if (has_drop && extremes_.width().sampled()) {
    r.drop = RunSummary::Drop{
        c.drop.diameter, *extremes_.width().sampled(), has_solid ? extremes_.restitution() : std::nullopt, {}, {}};
    if (c.drop.is_liquid()) r.drop->largest_mach_number = largest_mach_number_;
    if (c.drop.is_rigid() && last_)
      r.drop->rigid_motion = RunSummary::RigidMotion{
          {last_->drop_velocity_x, last_->drop_velocity_y}, last_->drop_angle, first_->drop_spin, last_->drop_spin};
  }

  if (c.solid.is_elastic() && extremes_.depth().sampled()) {
    const BeamProperties beam{c.solid.youngs_modulus, c.solid.poisson_ratio, c.solid.density, c.solid.length,
                              c.solid.thickness};
    RunSummary::Beam b;
    b.largest_deflection = *extremes_.depth().sampled();
    b.length = c.solid.length;
    b.measured_period = ringing_period();
    const bool is_cantilever = c.solid.kind == SolidKind::cantilever;
    if (c.solid.has_theory())
      b.theory_period =
          period_of(is_cantilever ? cantilever_angular_frequency(beam) : fixed_fixed_angular_frequency(beam));
    if (is_cantilever && c.solid.has_theory() && c.drop.shape == DropShape::round && c.drop.velocity_y < 0)
      b.theory_deflection =
          cantilever_largest_deflection(beam, round_drop_mass(c.drop.density, c.drop.diameter), -c.drop.velocity_y);
    r.beam = b;
  }
  if (first_ && last_) {
    if (has_drop) {
      const double mass = first_->drop_velocity_y != 0 ? first_->momentum_fluid_y / first_->drop_velocity_y
                                                       : last_->momentum_fluid_y / last_->drop_velocity_y;
      const double impulse_mass = (c.gravity.x != 0 || c.gravity.y != 0) && std::isfinite(mass) ? mass : 0.0;
      r.momentum = MomentumLedger{{first_->momentum_fluid_x, first_->momentum_fluid_y},
                                  {last_->momentum_fluid_x, last_->momentum_fluid_y},
                                  {last_->contact_impulse_x, last_->contact_impulse_y},
                                  impulse_mass * last_->time * Vector{c.gravity.x, c.gravity.y}};
    }
    const auto term = [&](const char* name, double Observation::*member, double sign = 1.0) {
      r.energy.push_back({name, sign * ((*first_).*member), sign * ((*last_).*member)});
    };
    if (has_drop) {
      term("kinetic, drop", &Observation::kinetic_fluid);
    }
    if (c.drop.is_liquid()) {
      term("compression, drop", &Observation::compressive);
      term("surface", &Observation::surface);
      if (c.is_wetting()) term("adhesion", &Observation::adhesion);
      term("dissipated, drop", &Observation::dissipated_fluid);
      term("density correction", &Observation::density_correction, -1.0);
      term("curve reconnection", &Observation::reconnection, -1.0);
      term("sharing of tension", &Observation::sharing_work, -1.0);
      if (c.fluid.gauge_pressure == Switch::on) {
        term("gauge pressure", &Observation::gauge);
        term("gauge adjustment", &Observation::gauge_adjustment, -1.0);
      }
      if (c.fluid.shifting == Switch::on) term("shifting", &Observation::shifting_work, -1.0);
    }
    if (is_beam) {
      term("kinetic, beam", &Observation::kinetic_solid);
      term("elastic, beam", &Observation::elastic);
      term("dissipated, beam", &Observation::dissipated_solid);
      term("artificial stress", &Observation::artificial_stress_work, -1.0);
    }
    if (r.contact) term("contact", &Observation::contact);
    if (r.contact && (c.contact.damping_ratio > 0 || c.contact.wall_drag > 0))
      term("dissipated, contact", &Observation::dissipated_contact);
    if (c.gravity.x != 0 || c.gravity.y != 0) term("gravity", &Observation::gravity);
    r.initial_kinetic_energy = first_->kinetic_fluid + first_->kinetic_solid;
  }

  r.wall_time = elapsed(start_);
  const auto& seconds = simulation_.timer().seconds();
  std::vector<double> all = communicator.all_gather(std::span<const double>(seconds));
  double largest = 0, total = 0;
  for (int rank = 0; rank < communicator.size(); ++rank) {
    const double* mine = all.data() + static_cast<std::size_t>(rank) * seconds.size();
    double busy = 0;
    for (const Phase phase :
         {Phase::fluid_sweep, Phase::solid_sweep, Phase::update, Phase::surface_tension, Phase::contact})
      busy += mine[static_cast<std::size_t>(phase)];
    largest = std::max(largest, busy);
    total += busy;
  }
  if (total > 0) r.load_imbalance = largest * communicator.size() / total;
  for (std::size_t k = 0; k < phase_names.size(); ++k) {
    double mean = 0;
    for (int rank = 0; rank < communicator.size(); ++rank)
      mean += all[static_cast<std::size_t>(rank) * seconds.size() + k];
    r.phases.push_back({std::string(phase_names[k]), mean / communicator.size()});
  }
  r.partition_imbalance = simulation_.distribution().quality().imbalance;
  r.repartitions = simulation_.distribution().quality().repartitions;
  r.traffic = traffic_of_ranks(simulation_, r.steps - r.first_step + 1);
  r.peak_memory = communicator.max(peak_memory());
  r.particles = simulation_.fluid_total() + simulation_.solid_total();
  r.ranks = communicator.size();
  r.state_hash = hash_;
  return r;
}

}  // namespace sphdrop
