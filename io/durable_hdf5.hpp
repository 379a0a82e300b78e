#pragma once
// HDF5 files that are whole under their name or not there at all, whatever the disk does: what snapshots and
// checkpoints share.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "decomposition/communicator.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {

/// A dataset of shape [total_rows] or [total_rows, components], of which every rank writes consecutive rows, in parts.
struct DatasetRows {
  std::string path;
  std::string unit;
  std::string description;
  Hdf5Type type = Hdf5Type::float64;
  std::int64_t total_rows = 0;
  int components = 1;
  int part_count = 1;  ///< the same on every rank
  /// Collective. Makes `bytes` this rank's rows of a part and returns the first one's number. Called once for each
  /// part, ascending, on all ranks alike. Whatever it throws, it throws CollectiveError on all ranks.
  std::function<std::int64_t(int part, std::vector<std::byte>& bytes)> take_part;

  std::size_t row_bytes() const { return size_in_bytes(type) * static_cast<std::size_t>(components); }
  std::int64_t total_bytes() const { return total_rows * static_cast<std::int64_t>(row_bytes()); }
};

/// Whether `text` can name a dataset: letters, digits and underscores, at least one.
bool is_dataset_name(std::string_view text);

/// A file that all ranks write together.
struct DurableHdf5 {
  /// On rank 0, with the serial driver: groups, attributes, and small datasets together with their values.
  std::function<void(Hdf5File&)> write_structure;
  /// Of the values that write_structure writes.
  std::int64_t structure_bytes = 0;
  /// Created behind the structure, with attributes `unit` and `description`. Values are written part by part: the first
  /// part of all of them, then the second of those that have one, and so on. No more than a part of one is held at a
  /// time.
  std::span<const DatasetRows> datasets;
  /// Bytes before HDF5's own: 0, 512, 1024, 2048, ...
  std::int64_t user_block = 0;
  /// Collective, may be empty: called with the closed file's path once all values are in it. Whatever it throws, it
  /// throws CollectiveError on all ranks.
  std::function<void(const std::string& path)> seal;
  /// As `seal`, once the file is on the disk: throws if it does not hold what was written. The datasets are compared
  /// beside it.
  std::function<void(const std::string& path)> verify;
};

/// Collective. The file is written aside as `path`.part on space reserved beforehand, flushed to the disk, read back
/// and compared, and only then renamed, so that `path` is whole or as it was. Throws CollectiveError; ends the program
/// if HDF5 cannot even close the file (see Hdf5File::close).
void write_hdf5_durably(const Communicator& communicator, const std::filesystem::path& path, const DurableHdf5& plan);

}  // namespace sphdrop
