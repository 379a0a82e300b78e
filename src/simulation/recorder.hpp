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
  Recorder(Simulation& simulation, const RecorderOptions& options);

  /// After every evaluate(): writes a history row and a snapshot when they are due, and shows progress.
  void observe();
  /// After the last observe(): the final row and snapshot, if they are not written yet. Returns the state's hash.
  std::uint64_t finish();

  RunSummary summary() const;
  /// The last snapshot that is known to be whole; empty if there is none.
  const std::filesystem::path& last_snapshot() const { return last_snapshot_; }

 private:
  void write_row();
  void write_snapshot();
  std::optional<double> ringing_period() const;
  template <class F>
  void on_first_rank(F&& f);

  Simulation& simulation_;
  RecorderOptions options_;
  std::optional<HistoryWriter> history_;  // on rank 0
  SnapshotSeries snapshots_;
  std::filesystem::path last_snapshot_;
  Progress progress_;
  Extremes extremes_;
  std::vector<double> ringing_times_, ringing_deflections_;  // since the last contact
  std::optional<Observation> first_, last_;
  double next_row_ = 0, next_snapshot_ = 0;
  std::int64_t last_snapshot_step_ = -1;
  std::uint64_t hash_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sphdrop
