#pragma once
// All of a checkpoint but its tables' values: what is the same on every rank.

#include <cstdint>
#include <span>
#include <string>

#include "io/checkpoint.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {

/// A table as the file describes it.
struct TableOutline {
  std::string name;
  std::int64_t total_rows = 0;
  std::int64_t first_id = 0;  ///< of the whole table
};

/// With the numbers' values; the columns' datasets are not made.
void write_outline(Hdf5File& file, const CheckpointHeader& header, std::span<const TableOutline> tables,
                   std::span<const CheckpointNumbers> numbers);

/// The tables have first_id of the whole table, row_count 0 and columns without values. Throws Hdf5Error or
/// CheckpointError if something is missing or is not as io/FORMAT.md says.
Checkpoint read_outline(const Hdf5File& file, const std::filesystem::path& path);

/// Bytes of the values that write_outline() writes.
std::int64_t outline_bytes(const CheckpointHeader& header, std::span<const CheckpointNumbers> numbers);

}  // namespace sphdrop
