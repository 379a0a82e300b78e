#pragma once
// A snapshot's datasets as this rank writes them: VTKHDF 1.0, UnstructuredGrid, one vertex cell a particle.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5_file.hpp"
#include "io/snapshot.hpp"
#include "io/snapshot_rows.hpp"

namespace sphdrop {

/// A dataset of shape [total_rows] or [total_rows, components] and this rank's consecutive rows of it.
struct SnapshotDataset {
  std::string path;
  std::string unit;
  std::string description;
  Hdf5Type type = Hdf5Type::float64;
  std::int64_t total_rows = 0;
  int components = 1;
  std::int64_t first_row = 0;
  std::vector<std::byte> bytes;

  std::size_t row_bytes() const { return size_in_bytes(type) * static_cast<std::size_t>(components); }
  std::int64_t row_count() const { return static_cast<std::int64_t>(bytes.size() / row_bytes()); }
  std::int64_t total_bytes() const { return total_rows * static_cast<std::int64_t>(row_bytes()); }
};

/// Collective: brings the columns into the order of ids. Throws SnapshotError on all ranks if the rows or columns are
/// not what SnapshotRows and SnapshotColumn say.
std::vector<SnapshotDataset> lay_out_snapshot(const Communicator& communicator, const SnapshotHeader& header,
                                              const SnapshotRows& rows, std::span<const SnapshotColumn> columns);

}  // namespace sphdrop
