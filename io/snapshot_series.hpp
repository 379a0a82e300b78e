#pragma once
// The snapshots of a run: numbered files and the index by which ParaView knows their times.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "io/snapshot.hpp"

namespace sphdrop {

/// Writes snapshot_000000.vtkhdf, snapshot_000001.vtkhdf, ... and after each of them snapshots.vtkhdf.series.
class SnapshotSeries {
 public:
  /// Collective. Takes up the snapshots that are in `directory` already; SnapshotError on all ranks if one is not
  /// readable. Those at `resume_time` (s) or later do not count: the run goes on from before them.
  SnapshotSeries(const Communicator& communicator, std::filesystem::path directory,
                 double resume_time = std::numeric_limits<double>::infinity());

  /// Collective. Writes the next snapshot and renews the index; returns the file's path. Snapshots at this time or
  /// later, left over from before a restart, leave the index and are overwritten one by one.
  std::filesystem::path write(const SnapshotHeader& header, const SnapshotRows& rows,
                              std::span<const SnapshotColumn> columns);

  /// The last one in the index; empty if there is none.
  std::filesystem::path last() const;

  /// Snapshots in the index.
  std::int64_t count() const { return static_cast<std::int64_t>(times_.size()); }

 private:
  const Communicator& communicator_;
  std::filesystem::path directory_;
  std::vector<double> times_;  ///< of the snapshots, s, ascending; the same on every rank
};

/// "snapshot_000042.vtkhdf".
std::string snapshot_file_name(std::int64_t number);

}  // namespace sphdrop
