#pragma once
// Columns of numbers that a user's file holds: text with a header line, or datasets of an HDF5 file.

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sphdrop {

/// What is wrong with such a file; the text begins with its name and the line, if there is one: "drop.csv:12: ...".
class TableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ColumnTable {
  struct Column {
    std::string name;
    std::string unit;  ///< "" where the file gives none
    std::vector<double> values;
  };
  std::vector<Column> columns;      ///< all of one length
  std::vector<std::int64_t> lines;  ///< of the text, from 1 on, of each row; empty for HDF5
  std::int64_t header_line = 0;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// nullptr if there is no such column.
  const Column* find(std::string_view name) const;
};

/// The columns `known` of a text: values between commas, # begins a comment, lines without anything else are passed
/// over, and the first that is left names the columns, each with a unit in brackets or without: `x [mm], y [mm]`. All
/// values must be finite numbers, with a point, whatever the locale. `file` stands in messages. Throws TableError, also
/// for columns that are not known.
ColumnTable parse_text_table(std::string_view text, const std::string& file, std::span<const std::string_view> known);

/// A dataset of shape [rows] or [rows, components], of which the first components become columns.
struct Hdf5Columns {
  std::string dataset;  ///< full path
  std::vector<std::string> names;
  bool is_required = false;  ///< what is not required may be missing
};

/// Whether a file that begins so is one of HDF5's.
bool is_hdf5(std::string_view content);

/// Whether the HDF5 file at `path` has this group, by its full path. Throws TableError.
bool has_hdf5_group(const std::string& path, const std::string& file, const std::string& group);

/// Reads `wanted` from the HDF5 file at `path`; by one rank. Throws TableError, also for values that are not finite.
ColumnTable read_hdf5_table(const std::string& path, const std::string& file, std::span<const Hdf5Columns> wanted);

}  // namespace sphdrop
