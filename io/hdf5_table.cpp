#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/column_table.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {
namespace {

std::string parent_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == 0 ? "/" : path.substr(0, slash);
}

bool holds(const std::vector<std::string>& names, const std::string& path) {
  return std::find(names.begin(), names.end(), path.substr(path.rfind('/') + 1)) != names.end();
}

bool has_group(const Hdf5File& file, const std::string& group) {
  if (group == "/") return true;
  return has_group(file, parent_of(group)) && holds(file.groups_in(parent_of(group)), group);
}

bool has_dataset(const Hdf5File& file, const std::string& dataset) {
  return has_group(file, parent_of(dataset)) && holds(file.datasets_in(parent_of(dataset)), dataset);
}

/// What f() returns; HDF5's complaints are told of the file by the name that the user knows.
template <class F>
auto told(const std::string& path, const std::string& file, F&& f) {
  try {
    return f();
  } catch (const Hdf5Error& error) {
    std::string text = error.what();
    if (text.starts_with(path)) text.erase(0, path.size());
    throw TableError(file + (text.starts_with(':') ? text : ": " + text));
  }
}

void append_columns(const Hdf5File& file, const std::string& name, const Hdf5Columns& wanted, ColumnTable& table) {
  const Hdf5Dataset dataset = file.open_dataset(wanted.dataset, Hdf5Type::float64);
  const auto width = static_cast<std::size_t>(dataset.components()), rows = static_cast<std::size_t>(dataset.rows());
  if (width < wanted.names.size())
    throw TableError(fmt::format("{}: {} has {} column{}, and {} are wanted: {}", name, wanted.dataset, width,
                                 width == 1 ? "" : "s", wanted.names.size(), fmt::join(wanted.names, ", ")));
  if (!table.columns.empty() && rows != table.rows())
    throw TableError(
        fmt::format("{}: {} has {} rows, and there are {} of the others", name, wanted.dataset, rows, table.rows()));
  std::vector<double> values(rows * width);
  dataset.read_rows(0, dataset.rows(), values.data());
  for (std::size_t c = 0; c < wanted.names.size(); ++c) {
    ColumnTable::Column column{wanted.names[c], "", std::vector<double>(rows)};
    for (std::size_t k = 0; k < rows; ++k) {
      column.values[k] = values[k * width + c];
      if (!std::isfinite(column.values[k]))
        throw TableError(
            fmt::format("{}: {} of row {} of {} is not a finite number", name, column.name, k, wanted.dataset));
    }
    table.columns.push_back(std::move(column));
  }
}

}  // namespace

bool is_hdf5(std::string_view content) {
  return content.starts_with("\x89HDF\r\n\x1a\n");
}

bool has_hdf5_group(const std::string& path, const std::string& file, const std::string& group) {
  return told(path, file, [&] { return has_group(Hdf5File::open_to_read(path), group); });
}

ColumnTable read_hdf5_table(const std::string& path, const std::string& file, std::span<const Hdf5Columns> wanted) {
  return told(path, file, [&] {
    const Hdf5File opened = Hdf5File::open_to_read(path);
    ColumnTable table;
    for (const Hdf5Columns& columns : wanted) {
      if (has_dataset(opened, columns.dataset)) {
        append_columns(opened, file, columns, table);
      } else if (columns.is_required) {
        throw TableError(fmt::format("{}: has no dataset {}", file, columns.dataset));
      }
    }
    return table;
  });
}

}  // namespace sphdrop
