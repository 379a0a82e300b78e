#include "io/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "io/json.hpp"

namespace sphdrop {
namespace {

constexpr auto longest_wait = std::chrono::seconds(1);

std::string header_line(std::span<const HistoryColumn> columns) {
  std::string line;
  for (const HistoryColumn& column : columns) {
    line += fmt::format("{}{} [{}]", line.empty() ? "" : ",", column.name, column.unit);
  }
  return line + '\n';
}

void check_columns(std::span<const HistoryColumn> columns) {
  if (columns.empty()) throw HistoryError("a history needs at least one column");
  std::set<std::string> names;
  for (const HistoryColumn& column : columns) {
    const bool is_name =
        !column.name.empty() && std::all_of(column.name.begin(), column.name.end(),
                                            [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    if (!is_name)
      throw HistoryError(fmt::format("'{}' is no name for a column: letters, digits and _ only", column.name));
    if (!names.insert(column.name).second) throw HistoryError(fmt::format("two columns are named '{}'", column.name));
    if (column.unit.empty() || column.unit.find_first_of(",[]\"\n\r") != std::string::npos) {
      throw HistoryError(fmt::format("column '{}': '{}' is no unit (1 for none)", column.name, column.unit));
    }
  }
}

void write_descriptions(const std::filesystem::path& directory, std::span<const HistoryColumn> columns) {
  JsonObject all;
  for (const HistoryColumn& column : columns) {
    JsonObject entry;
    entry.set("unit", column.unit);
    entry.set("description", column.description);
    all.set(column.name, entry);
  }
  write_file_atomically(directory / "history_columns.json", all.text() + '\n');
}

/// How much of a history is kept: the header and the whole rows before `time`; also the last time kept.
std::pair<std::size_t, double> kept_part(std::string_view text, std::size_t header_size, double time) {
  std::size_t kept = header_size;
  double last_time = -std::numeric_limits<double>::infinity();
  while (true) {
    const std::size_t end = text.find('\n', kept);
    if (end == std::string_view::npos) return {kept, last_time};
    double row_time = 0;
    const auto [stop, error] = std::from_chars(text.data() + kept, text.data() + end, row_time);
    const bool is_number = error == std::errc{} && (stop == text.data() + end || *stop == ',');
    if (!is_number || !(row_time < time)) return {kept, last_time};
    last_time = row_time;
    kept = end + 1;
  }
}

}  // namespace

HistoryWriter::HistoryWriter(std::filesystem::path path, FileDescriptor file, std::size_t column_count,
                             std::int64_t size)
    : path_(std::move(path)), file_(std::move(file)), column_count_(column_count), size_(size) {}

HistoryWriter HistoryWriter::create(const std::filesystem::path& directory, std::vector<HistoryColumn> columns) {
  check_columns(columns);
  const auto path = directory / "history.csv";
  try {
    write_descriptions(directory, columns);
    FileDescriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
    HistoryWriter writer(path, std::move(file), columns.size(), 0);
    writer.pending_ = header_line(columns);
    writer.flush();
    return writer;
  } catch (const std::system_error& error) {
    throw HistoryError(fmt::format("the history cannot be started: {}", error.what()));
  }
}

HistoryWriter HistoryWriter::resume(const std::filesystem::path& directory, std::vector<HistoryColumn> columns,
                                    double time) {
  check_columns(columns);
  const auto path = directory / "history.csv";
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return create(directory, std::move(columns));
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::string header = header_line(columns);
  if (!text.starts_with(header)) {
    throw HistoryError(
        fmt::format("{}: has other columns than this run writes; resume with the program and the case "
                    "that began it, or choose another output directory",
                    path.string()));
  }
  const auto [size, last_time] = kept_part(text, header.size(), time);
  try {
    FileDescriptor file(path, O_WRONLY | O_APPEND);
    file.truncate(static_cast<std::int64_t>(size));
    HistoryWriter writer(path, std::move(file), columns.size(), static_cast<std::int64_t>(size));
    writer.last_time_ = last_time;
    return writer;
  } catch (const std::system_error& error) {
    throw HistoryError(fmt::format("the history cannot be resumed: {}", error.what()));
  }
}

HistoryWriter::~HistoryWriter() {
  try {
    if (!pending_.empty()) flush();
  } catch (const HistoryError&) {
    // Reported to whoever calls close(); here, on the way out of another error, nobody could act on it.
  }
}

void HistoryWriter::append(std::span<const double> values) {
  if (values.size() != column_count_) {
    throw HistoryError(fmt::format("{} values for {} columns of {}", values.size(), column_count_, path_.string()));
  }
  if (!(values[0] > last_time_)) {
    throw HistoryError(
        fmt::format("{}: a row for the time {} after one for {}", path_.string(), values[0], last_time_));
  }
  last_time_ = values[0];
  for (std::size_t column = 0; column < values.size(); ++column) {
    fmt::format_to(std::back_inserter(pending_), "{}{}", column == 0 ? "" : ",", values[column]);
  }
  pending_ += '\n';
  if (std::chrono::steady_clock::now() - last_flush_ >= longest_wait) flush();
}

void HistoryWriter::flush() {
  try {
    file_.write(pending_);
  } catch (const std::system_error& error) {
    take_back_incomplete_row();
    pending_.clear();
    throw HistoryError(fmt::format("rows of the history are lost: {}", error.what()));
  }
  size_ += std::ssize(pending_);
  pending_.clear();
  last_flush_ = std::chrono::steady_clock::now();
}

void HistoryWriter::take_back_incomplete_row() noexcept {
  try {
    file_.truncate(size_);
  } catch (const std::system_error&) {
    // The write's own error is the one to report.
  }
}

void HistoryWriter::synchronise() {
  flush();
  try {
    file_.synchronise();
  } catch (const std::system_error& error) {
    throw HistoryError(fmt::format("the history may be incomplete: {}", error.what()));
  }
}

void HistoryWriter::close() {
  synchronise();
  try {
    file_.close();
  } catch (const std::system_error& error) {
    throw HistoryError(fmt::format("the history may be incomplete: {}", error.what()));
  }
}

}  // namespace sphdrop
