#pragma once
// The state of a run in one file, to go on from. It moves named columns and numbers and knows nothing of what they
// mean. io/FORMAT.md has the layout.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "decomposition/communicator.hpp"
#include "io/collective_error.hpp"
#include "io/pieces.hpp"

namespace sphdrop {

/// A checkpoint that could not be written or is not to be used; thrown on all ranks with the same text.
class CheckpointError : public CollectiveError {
 public:
  using CollectiveError::CollectiveError;
};

/// What the checkpoint is of. No text may contain null bytes.
struct CheckpointHeader {
  std::string name;        ///< of the case
  std::string version;     ///< of the program
  std::string git_commit;  ///< of the program
  double time = 0;         ///< s
  std::int64_t step = 0;
  std::uint64_t state_hash = 0;  ///< of the whole state, the same for any number of ranks
  std::string case_text;         ///< the effective case
};

/// A named quantity of a table's rows, shape [n] in the order of CheckpointTable::ids.
struct CheckpointColumn {
  std::string name;  ///< letters, digits and underscores
  std::string unit;  ///< SI; "1" without dimension
  std::string description;
  Pieces<double> values;  ///< where they lie
};

/// This rank's rows of a table. Every rank gives the same tables and columns in the same order.
struct CheckpointTable {
  std::string name;  ///< letters, digits and underscores; not "case" or "run"
  std::int64_t total_rows = 0;
  /// Shape [n], in any order. Those of all ranks together are first_id ... first_id + total_rows - 1, once each, where
  /// first_id, the smallest, is not negative.
  Pieces<std::int64_t> ids;
  std::vector<CheckpointColumn> columns;
};

/// Named numbers of the whole run.
struct CheckpointNumbers {
  std::string name;  ///< letters, digits and underscores
  std::string unit;  ///< SI; "1" without dimension
  std::string description;
  std::vector<double> values;
};

/// Collective. Writes `directory`/checkpoint_<step, 12 digits>.h5 and returns its path. The bytes do not depend on the
/// number of ranks or on who owns what; of the numbers those of rank 0 are written. The file is written aside on space
/// reserved beforehand, sealed by checksums, flushed to the disk, read back and compared, and only then renamed. After
/// that all checkpoints go that are older than the newest `keep` (at least 1), and so do those of later steps, which
/// the run has given up by going back to an earlier one, and what crashes left of others. Takes a few bytes a row
/// beside the columns. Throws CheckpointError on all ranks, earlier checkpoints being untouched; ends the program if
/// HDF5 cannot even close the file (see Hdf5File::close).
std::filesystem::path write_checkpoint(const Communicator& communicator, const std::filesystem::path& directory,
                                       const CheckpointHeader& header, std::span<const CheckpointTable> tables,
                                       std::span<const CheckpointNumbers> numbers, int keep = 2);

/// A checkpoint as one rank has read it.
struct Checkpoint {
  struct Column {
    std::string name;
    std::string unit;
    std::string description;
    std::vector<double> values;  ///< shape [n], of the rows this rank has
  };
  struct Table {
    std::string name;
    std::int64_t total_rows = 0;
    std::int64_t first_id = 0;  ///< of this rank's rows, whose ids ascend by one
    std::int64_t row_count = 0;
    std::vector<Column> columns;  ///< in the order of their names
  };

  std::filesystem::path path;
  CheckpointHeader header;
  std::vector<Table> tables;               ///< in the order of their names
  std::vector<CheckpointNumbers> numbers;  ///< in the order of their names

  /// These throw CheckpointError if the checkpoint lacks what is asked for: on this rank, but all ranks that ask for
  /// the same hear the same.
  const Table& table(std::string_view name) const;
  const std::vector<double>& column(std::string_view table_name, std::string_view name) const;
  const std::vector<double>& numbers_of(std::string_view name) const;
};

/// Collective. Makes sure that the file is a checkpoint of this format and that its bytes are those that were written.
/// Throws CheckpointError on all ranks.
void verify_checkpoint(const Communicator& communicator, const std::filesystem::path& path);

/// Collective. verify_checkpoint(), then reads it: every rank gets the header, the numbers and an equal share of each
/// table's rows, the shares ascending with the ranks. Throws CheckpointError on all ranks.
Checkpoint read_checkpoint(const Communicator& communicator, const std::filesystem::path& path);

/// The checkpoints in a directory, by their names, newest first. None if the directory cannot be listed.
std::vector<std::filesystem::path> find_checkpoints(const std::filesystem::path& directory);

/// A checkpoint and why newer ones were passed over.
struct LatestCheckpoint {
  Checkpoint checkpoint;
  std::vector<std::string> refused;
};

/// Collective. The newest checkpoint in the directory that can be read. Throws CheckpointError on all ranks if there is
/// none.
LatestCheckpoint read_latest_checkpoint(const Communicator& communicator, const std::filesystem::path& directory);

}  // namespace sphdrop
