#include "io/snapshot_layout.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <numeric>
#include <set>

#include "io/collective_error.hpp"
#include "io/rows_by_id.hpp"

namespace sphdrop {
namespace {

constexpr std::uint8_t vtk_vertex = 1;

template <class T>
std::vector<std::byte> to_bytes(std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

/// What is wrong with the arguments on this rank; empty if nothing is.
std::string check_columns(const SnapshotRows& rows, std::span<const SnapshotColumn> columns) {
  const std::size_t n = rows.ids.size();
  if (rows.x.size() != n || rows.y.size() != n) {
    return fmt::format("{} ids, but {} and {} coordinates", n, rows.x.size(), rows.y.size());
  }
  std::set<std::string> names = {"id"};
  for (const SnapshotColumn& column : columns) {
    if (!is_dataset_name(column.name))
      return fmt::format("'{}' is no name for a column: letters, digits and _ only", column.name);
    if (!names.insert(column.name).second) return fmt::format("two columns are named '{}'", column.name);
    const bool real = !column.components.empty();
    if (column.components.size() > 3) return fmt::format("column '{}': more than three components", column.name);
    if (real && !column.integers.empty()) return fmt::format("column '{}': both reals and integers", column.name);
    for (const auto& component : column.components) {
      if (component.size() != n)
        return fmt::format("column '{}': {} values for {} rows", column.name, component.size(), n);
    }
    if (!real && column.integers.size() != n) {
      return fmt::format("column '{}': {} values for {} rows", column.name, column.integers.size(), n);
    }
  }
  return {};
}

/// Columns sorted by id one at a time, as an exchange of all at once would need all their memory twice more.
class SortedRows {
 public:
  explicit SortedRows(RowsById& by_id) : by_id_(by_id), values_(static_cast<std::size_t>(by_id.block().size())) {}

  /// Collective. Rows of `width` numbers; missing components are zero. Integers travel as the 8 bytes of a double:
  /// nothing looks at them as a number on the way.
  std::vector<std::byte> of(std::span<const void* const> components, std::size_t width) {
    constexpr std::size_t number = sizeof(double);
    std::vector<std::byte> rows(values_.size() * width * number);  // zeros
    for (std::size_t c = 0; c < components.size(); ++c) {
      by_id_.redistribute(components.subspan(c, 1), std::array<void*, 1>{values_.data()});
      for (std::size_t row = 0; row < values_.size(); ++row)
        std::memcpy(rows.data() + (row * width + c) * number, &values_[row], number);
    }
    return rows;
  }

 private:
  RowsById& by_id_;
  std::vector<double> values_;
};

/// A dataset of a single value, which rank 0 writes.
template <class T>
DatasetRows single_value(const Communicator& communicator, std::string path, std::string unit, std::string description,
                         Hdf5Type type, T value) {
  DatasetRows dataset{std::move(path), std::move(unit), std::move(description), type, 1, 1, 0, {}};
  if (communicator.rank() == 0) dataset.bytes = to_bytes<T>(std::span<const T>(&value, 1));
  return dataset;
}

/// The arrays by which VTK knows that every point is a cell of its own.
void append_cells(const Communicator& communicator, std::int64_t total, const RowBlock& block,
                  std::vector<DatasetRows>& datasets) {
  const auto n = static_cast<std::size_t>(block.size());
  datasets.push_back(
      single_value(communicator, "/VTKHDF/NumberOfPoints", "1", "number of particles", Hdf5Type::int64, total));
  datasets.push_back(single_value(communicator, "/VTKHDF/NumberOfCells", "1", "number of cells, one vertex a particle",
                                  Hdf5Type::int64, total));
  datasets.push_back(single_value(communicator, "/VTKHDF/NumberOfConnectivityIds", "1", "length of Connectivity",
                                  Hdf5Type::int64, total));
  datasets.push_back({"/VTKHDF/Types", "1", "VTK cell type: 1, vertex", Hdf5Type::uint8, total, 1, block.first,
                      std::vector<std::byte>(n, std::byte{vtk_vertex})});
  const bool writes_last_offset = communicator.rank() == communicator.size() - 1;
  std::vector<std::int64_t> numbers(n + (writes_last_offset ? 1 : 0));
  std::iota(numbers.begin(), numbers.end(), block.first);
  datasets.push_back({"/VTKHDF/Connectivity", "1", "the point of each cell", Hdf5Type::int64, total, 1, block.first,
                      to_bytes<std::int64_t>(std::span(numbers).first(n))});
  datasets.push_back({"/VTKHDF/Offsets", "1", "where each cell begins in Connectivity", Hdf5Type::int64, total + 1, 1,
                      block.first, to_bytes<std::int64_t>(numbers)});
}

void append_field_data(const Communicator& communicator, const SnapshotHeader& header,
                       std::vector<DatasetRows>& datasets) {
  datasets.push_back(
      single_value(communicator, "/VTKHDF/FieldData/TimeValue", "s", "time", Hdf5Type::float64, header.time));
  datasets.push_back(
      single_value(communicator, "/VTKHDF/FieldData/step", "1", "number of the step", Hdf5Type::int64, header.step));
  datasets.push_back(single_value(communicator, "/VTKHDF/FieldData/state_hash", "1", "hash of the state",
                                  Hdf5Type::uint64, header.state_hash));
}

}  // namespace

std::vector<DatasetRows> lay_out_snapshot(const Communicator& communicator, const SnapshotHeader& header,
                                          const SnapshotRows& rows, std::span<const SnapshotColumn> columns) {
  throw_if_any_failed<CollectiveError>(communicator, check_columns(rows, columns));
  RowsById by_id(communicator, 0, rows.total, rows.ids);
  const RowBlock& block = by_id.block();
  SortedRows sorted(by_id);

  std::vector<DatasetRows> datasets;
  append_cells(communicator, rows.total, block, datasets);
  const auto append = [&](std::string path, std::string unit, std::string description, Hdf5Type type, int components,
                          std::vector<std::byte> bytes) {
    datasets.push_back({std::move(path), std::move(unit), std::move(description), type, rows.total, components,
                        block.first, std::move(bytes)});
  };
  append("/VTKHDF/Points", "m", "position", Hdf5Type::float64, 3,
         sorted.of(std::array<const void*, 2>{rows.x.data(), rows.y.data()}, 3));
  std::vector<std::int64_t> ids(static_cast<std::size_t>(block.size()));
  std::iota(ids.begin(), ids.end(), block.first);
  append("/VTKHDF/PointData/id", "1", "global id of the particle", Hdf5Type::int64, 1, to_bytes<std::int64_t>(ids));
  for (const SnapshotColumn& column : columns) {
    const std::string path = "/VTKHDF/PointData/" + column.name;
    if (column.components.empty()) {
      append(path, column.unit, column.description, Hdf5Type::int64, 1,
             sorted.of(std::array<const void*, 1>{column.integers.data()}, 1));
      continue;
    }
    std::vector<const void*> components;
    for (const auto& component : column.components) components.push_back(component.data());
    const int width = components.size() == 1 ? 1 : 3;
    append(path, column.unit, column.description, Hdf5Type::float64, width,
           sorted.of(components, static_cast<std::size_t>(width)));
  }
  append_field_data(communicator, header, datasets);
  return datasets;
}

}  // namespace sphdrop
