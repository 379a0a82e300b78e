#pragma once
// What a run leaves behind: history, snapshots, progress, and the summary at the end.

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "diagnostics/extremes.hpp"
#include "diagnostics/progress.hpp"
#include "diagnostics/summary.hpp"
#include "io/checkpoint.hpp"
#include "io/history.hpp"
#include "io/provenance.hpp"
#include "io/snapshot_series.hpp"
#include "simulation/observation.hpp"

namespace sphdrop {

struct RecorderOptions {
  std::filesystem::path directory;
  double end_time = 0;                              ///< simulated time at which the run stops, s
  Progress::Mode progress = Progress::Mode::quiet;  ///< on rank 0
  std::string version;
};

/// Watches a simulation; all calls are collective. Output of rank 0 that fails throws on all ranks.
class Recorder {
 public:
  /// With a `checkpoint` it goes on with what the run it is of has left behind, which may be nothing in this folder.
  Recorder(Simulation& simulation, const RecorderOptions& options, const Checkpoint* checkpoint = nullptr);

  /// After every evaluate(): writes a history row and a snapshot when they are due, and shows progress.
  void observe();
  /// After the last observe(): the final row and snapshot, if they are not written yet. Returns the state's hash.
  std::uint64_t finish();

  /// The run stops here and goes on another time: what is written reaches the disk, and nothing is added.
  void interrupt();

  RunSummary summary() const;
  /// What a restored run needs beside the simulation's state; the same on every rank.
  std::vector<CheckpointNumbers> save() const;
  /// Sees to it that everything observed so far is on the disk, so that a checkpoint never is ahead of it.
  void synchronise();
  /// The last snapshot that is known to be whole; empty if there is none.
  std::filesystem::path last_snapshot() const { return snapshots_.last(); }

 private:
  void restore(const Checkpoint& checkpoint);
  void watch_speed();
  void write_row();
  void write_snapshot();
  std::optional<double> ringing_period() const;
  template <class F>
  void on_first_rank(F&& f);

  Simulation& simulation_;
  RecorderOptions options_;
  std::optional<HistoryWriter> history_;  // on rank 0
  SnapshotSeries snapshots_;
  Progress progress_;
  Extremes extremes_;
  std::vector<double> ringing_times_, ringing_deflections_;  // since the last contact
  std::optional<Observation> first_, last_;
  Peak largest_mach_number_;  // of the liquid, at any step
  double next_row_ = 0, next_snapshot_ = 0;
  std::int64_t first_step_;
  std::int64_t last_snapshot_step_ = -1;
  std::uint64_t hash_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sphdrop
