#pragma once
// Runs a case on this process alone and keeps what is watched at equal intervals.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "simulation/observation.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop::test {

/// MPI for test programs that run without mpirun: alive from first use to the end of the program.
inline const Communicator& lone_process() {
  static const struct Mpi {
    Mpi() {
      int is_initialised = 0;
      MPI_Initialized(&is_initialised);
      if (!is_initialised) MPI_Init(nullptr, nullptr);
      communicator.emplace(MPI_COMM_SELF);
    }
    ~Mpi() {
      communicator.reset();
      MPI_Finalize();
    }
    std::optional<Communicator> communicator;
  } mpi;
  return *mpi.communicator;
}

struct WatchedRun {
  std::vector<Observation> rows;
  ContactRecord contact;

  std::vector<double> column(double Observation::*member) const {
    std::vector<double> values;
    for (const Observation& row : rows) values.push_back(row.*member);
    return values;
  }
  const Observation& first() const { return rows.front(); }
  const Observation& last() const { return rows.back(); }

  /// Mean over the rows from `from` (s) on.
  double mean_from(double from, double Observation::*member) const {
    double sum = 0, count = 0;
    for (const Observation& row : rows)
      if (row.time >= from) {
        sum += row.*member;
        count += 1;
      }
    return sum / count;
  }
};

/// Runs to time.end, observing every `interval` seconds and at the end; `each_step` is called after every evaluate().
inline WatchedRun watch(const std::string& case_text, double interval,
                        const std::function<void(const Simulation&)>& each_step = {}) {
  const Case input = parse_case_text(case_text, "test.cfg").values;
  const InitialState initial = build_initial_state(input);
  Simulation simulation(lone_process(), input, initial.fluid, initial.solid);
  WatchedRun run;
  double next = 0;
  for (;;) {
    simulation.evaluate();
    if (each_step) each_step(simulation);
    const bool is_last = simulation.time() >= input.time.end;
    if (is_last || simulation.time() >= next) {
      run.rows.push_back(observe(simulation, run.rows.empty() ? 0.0 : run.rows.front().total));
      next += interval;
    }
    if (is_last) break;
    simulation.move();
  }
  run.rows.front().unaccounted = 0;
  run.contact = simulation.contact().record();
  return run;
}

}  // namespace sphdrop::test
