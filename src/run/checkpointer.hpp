#pragma once
// When a run writes checkpoints and when it stops to be taken up another time.

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "simulation/recorder.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {

struct CheckpointerOptions {
  std::filesystem::path directory;
  std::string version, git_commit;              ///< of the program
  std::chrono::steady_clock::time_point start;  ///< of the program
  std::optional<double> walltime_limit;         ///< from that start on, s; the run stops in good time before
  std::filesystem::path restarted_from;         ///< empty in a run from the beginning
};

/// In a step: wish() goes to Simulation::move(), act() comes after Simulation::settle(). A wish of one rank becomes
/// known to all with the step's reduction, so that all act together.
class Checkpointer {
 public:
  Checkpointer(Simulation& simulation, Recorder& recorder, const CheckpointerOptions& options);

  /// What this rank asks for: a checkpoint because it is time for one, a stop because a signal came or the wall time
  /// runs out, or nothing (0).
  double wish();

  /// Collective. Writes a checkpoint if one is due or wished for. Returns why the run is to stop, once its last
  /// checkpoint is written; empty to go on. A checkpoint that cannot be written is told and tried again at the next
  /// occasion, but if it was the last one CheckpointError is thrown on all ranks.
  std::string act();

  /// Collective, after act() at the end of the run, which may be prolonged some day: a checkpoint unless one was just
  /// written. One that cannot be written is told, no more: the results are there.
  void finish();

  const std::filesystem::path& last_checkpoint() const { return last_checkpoint_; }

 private:
  void write();
  void write_or_warn();
  double seconds_since_start() const;
  double expected_cost() const;

  Simulation& simulation_;
  Recorder& recorder_;
  CheckpointerOptions options_;
  std::filesystem::path last_checkpoint_;
  std::int64_t last_step_ = -1;
  double next_time_;                 ///< simulated, s
  double next_wall_;                 ///< since the program's start, s; steers wishes of rank 0 alone
  std::optional<double> last_cost_;  ///< wall time of the last checkpoint, s
};

}  // namespace sphdrop
