#pragma once
// The watched quantities over time, as text that pandas, numpy and a spreadsheet read. Used by one rank alone.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/posix_file.hpp"

namespace sphdrop {

class HistoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A column of the history; the header's cell is "name [unit]".
struct HistoryColumn {
  std::string name;  ///< letters, digits and underscores
  std::string unit;  ///< SI; "1" without dimension
  std::string description;
};

/// Writes history.csv row by row, and the columns' descriptions beside it in history_columns.json. The first column,
/// the time, ascends. Rows are whole lines: what a full disk cuts off is taken back.
class HistoryWriter {
 public:
  /// Starts a new history in `directory`, replacing any that is there. Throws HistoryError.
  static HistoryWriter create(const std::filesystem::path& directory, std::vector<HistoryColumn> columns);

  /// Goes on with the history in `directory`, which must have the same columns: keeps its whole rows with a time before
  /// `time` (s) and drops the others, written by a run that went on past its last checkpoint or was cut off in a line.
  /// Without a history there it is create(). Throws HistoryError.
  static HistoryWriter resume(const std::filesystem::path& directory, std::vector<HistoryColumn> columns, double time);

  HistoryWriter(HistoryWriter&&) noexcept = default;
  HistoryWriter& operator=(HistoryWriter&&) = delete;
  HistoryWriter(const HistoryWriter&) = delete;
  HistoryWriter& operator=(const HistoryWriter&) = delete;
  /// Writes what is left as far as possible; call close() to hear of errors.
  ~HistoryWriter();

  /// One value a column, written in the shortest form that reads back to the same bits. Rows reach the file at least
  /// once a second of wall time, as long as rows come. Throws HistoryError.
  void append(std::span<const double> values);
  /// Hands the rows so far to the operating system. Throws HistoryError.
  void flush();
  /// As flush(), and on to the disk. Throws HistoryError.
  void synchronise();
  /// As synchronise(); no row may follow. Throws HistoryError.
  void close();

 private:
  HistoryWriter(std::filesystem::path path, FileDescriptor file, std::size_t column_count, std::int64_t size);
  void take_back_incomplete_row() noexcept;

  std::filesystem::path path_;
  FileDescriptor file_;
  std::size_t column_count_;
  std::int64_t size_;    ///< bytes in the file, all of them whole lines
  std::string pending_;  ///< whole lines not yet in the file
  double last_time_ = -std::numeric_limits<double>::infinity();
  std::chrono::steady_clock::time_point last_flush_{};
};

}  // namespace sphdrop
