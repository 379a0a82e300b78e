#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/column_table.hpp"

namespace sphdrop {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

/// For a message: short, and without what a terminal would take for something else.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result;
  for (const char c : text.substr(0, longest)) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return fmt::format("\"{}{}\"", result, text.size() > longest ? "..." : "");
}

/// NaN where it is no finite number.
double number_of(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_number = error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

class TextTable {
 public:
  TextTable(const std::string& file, std::span<const std::string_view> known) : file_(file), known_(known) {}

  void take_line(std::string_view line) {
    ++line_;
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) return;
    const std::vector<std::string_view> cells = cells_of(line);
    if (table_.columns.empty()) {
      take_header(cells);
    } else {
      take_row(cells);
    }
  }

  ColumnTable finish() {
    if (table_.columns.empty())
      throw TableError(fmt::format("{}: is empty; its first line must name the columns: {}", file_, example()));
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const {
    throw TableError(fmt::format("{}:{}: {}", file_, line_, message));
  }
  std::string example() const {
    return fmt::format("{}", fmt::join(known_.first(std::min<std::size_t>(2, known_.size())), ","));
  }

  void take_header(const std::vector<std::string_view>& cells) {
    table_.header_line = line_;
    if (std::all_of(cells.begin(), cells.end(), [](std::string_view cell) { return !std::isnan(number_of(cell)); }))
      refuse(fmt::format("the first line must name the columns, for example {}, and holds numbers", example()));
    for (const std::string_view cell : cells) {
      const std::size_t bracket = cell.find('[');
      const std::string_view name = trimmed(cell.substr(0, bracket));
      if (bracket != std::string_view::npos && cell.find(']') != cell.size() - 1)
        refuse(
            fmt::format("{} is no name of a column; write name or name [unit], with a comma between two", shown(cell)));
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        refuse(fmt::format("there is no column {}; there are {}, with a comma between two", shown(name),
                           fmt::join(known_, ", ")));
      if (table_.find(name) != nullptr) refuse(fmt::format("the column {} stands twice", name));
      const std::string_view unit =
          bracket == std::string_view::npos ? "" : trimmed(cell.substr(bracket + 1, cell.size() - bracket - 2));
      table_.columns.push_back({std::string(name), std::string(unit), {}});
    }
  }

  void take_row(const std::vector<std::string_view>& cells) {
    if (cells.size() != table_.columns.size())
      refuse(fmt::format("holds {} value{}, and the first line names {} column{}", cells.size(),
                         cells.size() == 1 ? "" : "s", table_.columns.size(), table_.columns.size() == 1 ? "" : "s"));
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const double value = number_of(cells[k]);
      if (std::isnan(value))
        refuse(cells[k].empty() ? fmt::format("{} has no value", table_.columns[k].name)
                                : fmt::format("{} = {} is not a finite number; write numbers as 0.5, -1, 1e-3",
                                              table_.columns[k].name, shown(cells[k])));
      table_.columns[k].values.push_back(value);
    }
    table_.lines.push_back(line_);
  }

  const std::string& file_;
  std::span<const std::string_view> known_;
  std::int64_t line_ = 0;
  ColumnTable table_;
};

}  // namespace

const ColumnTable::Column* ColumnTable::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

ColumnTable parse_text_table(std::string_view text, const std::string& file, std::span<const std::string_view> known) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  TextTable table(file, known);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    table.take_line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return table.finish();
}

}  // namespace sphdrop
