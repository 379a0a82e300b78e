#pragma once
// A simulation and all that the program leaves behind of it.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "decomposition/communicator.hpp"
#include "diagnostics/progress.hpp"
#include "diagnostics/summary.hpp"
#include "io/provenance.hpp"
#include "io/run_lock.hpp"
#include "run/checkpointer.hpp"
#include "run/restart.hpp"
#include "setup/initial_state.hpp"
#include "simulation/recorder.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {

struct RecordedRunOptions {
  std::string case_file, case_text;      ///< the user's file, not to be overwritten by the results; or empty
  std::optional<std::string> restart;    ///< "latest", "auto" (latest if there is any) or a checkpoint's path
  bool fresh = false;                    ///< begin anew, whatever checkpoints there are
  std::optional<double> until;           ///< simulated time to stop at before time.end, s
  std::optional<double> walltime_limit;  ///< from `start` on, s
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();  ///< of the program
  Progress::Mode progress = Progress::Mode::quiet;
  std::vector<std::string> arguments;  ///< for the record
};

/// A run in its folder, input.output.directory: history, snapshots, checkpoints, record, from the beginning or taken
/// up. arrive(), then as long as it is neither stopped nor at its end go_on() and arrive(), at last finish(). All calls
/// are collective; the communicator must outlive the run.
class RecordedRun {
 public:
  /// Prepares the folder, holds it locked, and sets the simulation up. Throws OutputDirectoryError, RestartError,
  /// RunRecordError and HistoryError. Of the drop only this rank's share is needed. The initial state is let go as soon
  /// as the simulation has it.
  RecordedRun(const Communicator& communicator, const Case& input, InitialState initial,
              const RecordedRunOptions& options);

  /// Brings the simulation to the present instant, which may then be looked at, and writes what is due. If it is to
  /// stop here, for the wall time or a signal, it writes a checkpoint and the record instead; see stopped(). Throws
  /// SafetyError, which names the last good snapshot, and what writing throws.
  void arrive();
  /// Why the run has stopped before its end; empty if it has not.
  const std::string& stopped() const { return stopped_; }
  bool is_at_end() const { return simulation_->time() >= end_; }
  void go_on() { simulation_->move(checkpointer_->wish()); }

  /// After arrive(), at the end or before: the last row and snapshot and the record.
  RunSummary finish();

  Simulation& simulation() { return *simulation_; }
  const Simulation& simulation() const { return *simulation_; }
  double end() const { return end_; }
  const std::filesystem::path& last_checkpoint() const { return checkpointer_->last_checkpoint(); }

 private:
  [[noreturn]] void record_unsafe_state(const SafetyError& error);

  const Communicator& communicator_;
  std::filesystem::path directory_;
  double end_;  // s
  std::optional<RunLock> lock_;
  std::optional<RunRecord> record_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Checkpointer> checkpointer_;
  std::string stopped_;
};

}  // namespace sphdrop
