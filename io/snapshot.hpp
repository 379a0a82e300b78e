#pragma once
// One state of the particles in one file: VTKHDF, which ParaView and h5py read as it is. io/FORMAT.md has the layout.

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "decomposition/communicator.hpp"
#include "io/pieces.hpp"

namespace sphdrop {

/// A snapshot that could not be written or read; thrown on all ranks with the same text.
class SnapshotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the snapshot is of.
struct SnapshotHeader {
  double time = 0;  ///< s
  std::int64_t step = 0;
  std::uint64_t state_hash = 0;  ///< of the whole state, the same for any number of ranks
  std::string name;              ///< of the case
  std::string version;           ///< of the program
};

/// This rank's rows: shapes [n], where they lie. The ids of all ranks together are 0 ... total - 1, in any order, once
/// each.
struct SnapshotRows {
  std::int64_t total = 0;
  Pieces<std::int64_t> ids;
  Pieces<double> x, y;  ///< positions, m
};

/// A named quantity of the rows, in the order of SnapshotRows::ids.
struct SnapshotColumn {
  std::string name;  ///< letters, digits and underscores; not "id", which the snapshot writes itself
  std::string unit;  ///< SI; "1" without dimension
  std::string description;
  /// One a component, shape [n] each. Two components are filed with a third that is zero, as VTK wants vectors.
  std::vector<Pieces<double>> components;
  /// Instead of components: integers, shape [n].
  Pieces<std::int64_t> integers;

  static SnapshotColumn scalar(std::string name, std::string unit, std::string description, Pieces<double> values);
  static SnapshotColumn vector(std::string name, std::string unit, std::string description, Pieces<double> x,
                               Pieces<double> y);
  static SnapshotColumn integer(std::string name, std::string description, Pieces<std::int64_t> values);
};

/// Collective. Writes `path` in ascending order of ids; the bytes do not depend on the number of ranks or on who owns
/// what. The file is written aside as `path`.part on space reserved beforehand, flushed to the disk, read back and
/// compared, and only then renamed, so that `path` is whole or as it was. Throws SnapshotError on all ranks; ends the
/// program if HDF5 cannot even close the file (see Hdf5File::close). Takes a few bytes a row beside the columns.
void write_snapshot(const Communicator& communicator, const std::filesystem::path& path, const SnapshotHeader& header,
                    const SnapshotRows& rows, std::span<const SnapshotColumn> columns);

}  // namespace sphdrop
