#include "run/checkpointer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "config/effective_case.hpp"
#include "decomposition/stop_signal.hpp"
#include "time_integration/due_time.hpp"

namespace sphdrop {

namespace {

// Wishes, the stronger the larger; that of a signal is this and its number.
constexpr double wish_checkpoint = 1, wish_stop_for_walltime = 2, wish_stop_for_signal = 1000;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Checkpointer::Checkpointer(Simulation& simulation, Recorder& recorder, const CheckpointerOptions& options)
    : simulation_(simulation),
      recorder_(recorder),
      options_(options),
      last_checkpoint_(options.restarted_from),
      next_time_(next_multiple(simulation.time(), simulation.input().checkpoint.interval)) {
  const double interval = simulation.input().checkpoint.wall_interval;
  next_wall_ = interval > 0 ? seconds_since_start() + interval : infinity;
}

double Checkpointer::seconds_since_start() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - options_.start).count();
}

// What the last one took, and before there is one a generous guess: a second, and 3 us a particle.
double Checkpointer::expected_cost() const {
  const auto particles = static_cast<double>(simulation_.fluid_total() + simulation_.solid_total());
  return last_cost_.value_or(1.0 + 3e-6 * particles);
}

double Checkpointer::wish() {
  if (const int signal = caught_stop_signal(); signal != 0) return wish_stop_for_signal + signal;
  if (simulation_.communicator().rank() != 0) return 0;
  const double now = seconds_since_start();
  // The margin covers a checkpoint that takes three times as long as expected, and leaving.
  if (options_.walltime_limit && now + 3 * expected_cost() + 2 >= *options_.walltime_limit)
    return wish_stop_for_walltime;
  return now >= next_wall_ ? wish_checkpoint : 0;
}

std::string Checkpointer::act() {
  const double wish = simulation_.request();
  const bool is_time = simulation_.time() >= next_time_;
  if (wish == 0 && !is_time) return {};
  if (is_time) next_time_ = next_multiple(simulation_.time(), simulation_.input().checkpoint.interval);
  const bool stops = wish >= wish_stop_for_walltime;
  if (stops)
    write();
  else
    write_or_warn();
  if (const double interval = simulation_.input().checkpoint.wall_interval; interval > 0)
    next_wall_ = seconds_since_start() + interval;
  if (!stops) return {};
  if (wish < wish_stop_for_signal) return "the wall time runs out";
  return fmt::format("{} came", signal_name(static_cast<int>(wish - wish_stop_for_signal)));
}

void Checkpointer::finish() {
  if (last_step_ != simulation_.step()) write_or_warn();
}

void Checkpointer::write_or_warn() {
  try {
    write();
  } catch (const CheckpointError& error) {
    if (simulation_.communicator().rank() == 0)
      fmt::print(stderr, "warning: {}; the run goes on, its last checkpoint is {}\n", error.what(),
                 last_checkpoint_.empty() ? "none" : last_checkpoint_.string());
  }
}

void Checkpointer::write() {
  const double begin = seconds_since_start();
  recorder_.synchronise();
  const SavedSimulation saved = simulation_.save();
  std::vector<CheckpointNumbers> numbers = saved.numbers;
  for (CheckpointNumbers& n : recorder_.save()) numbers.push_back(std::move(n));
  Case input = simulation_.input();
  input.output.directory = "auto";  // a checkpoint does not depend on where it is
  const Communicator& communicator = simulation_.communicator();
  const CheckpointHeader header{input.name,
                                options_.version,
                                options_.git_commit,
                                simulation_.time(),
                                simulation_.step(),
                                communicator.sum(saved.hash()),
                                effective_case_text(input)};
  const CheckpointTable tables[] = {saved.fluid.table(), saved.solid.table()};
  last_checkpoint_ = write_checkpoint(communicator, options_.directory, header, tables, numbers,
                                      static_cast<int>(input.checkpoint.keep));
  last_step_ = simulation_.step();
  last_cost_ = seconds_since_start() - begin;
  simulation_.timer().lap(Phase::output);
}

}  // namespace sphdrop
