#include "io/snapshot_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <utility>

#include "io/collective_error.hpp"

namespace sphdrop {
namespace {

constexpr std::uint8_t vtk_vertex = 1;

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
    if (real && column.integers.size() > 0) return fmt::format("column '{}': both reals and integers", column.name);
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

const SnapshotRows& checked(const Communicator& communicator, const SnapshotRows& rows,
                            std::span<const SnapshotColumn> columns) {
  throw_if_any_failed<CollectiveError>(communicator, check_columns(rows, columns));
  return rows;
}

}  // namespace

SnapshotLayout::SnapshotLayout(const Communicator& communicator, const SnapshotHeader& header, const SnapshotRows& rows,
                               std::span<const SnapshotColumn> columns)
    : communicator_(communicator),
      total_(rows.total),
      by_id_(communicator, 0, rows.total, checked(communicator, rows, columns).ids) {
  add_cells();
  add_column<double>("/VTKHDF/Points", "m", "position", Hdf5Type::float64, std::array{rows.x, rows.y}, 3);
  add_numbered("/VTKHDF/PointData/id", "global id of the particle", total_);
  for (const SnapshotColumn& column : columns) {
    const std::string path = "/VTKHDF/PointData/" + column.name;
    if (column.components.empty())
      add_column<std::int64_t>(path, column.unit, column.description, Hdf5Type::int64, {&column.integers, 1}, 1);
    else
      add_column<double>(path, column.unit, column.description, Hdf5Type::float64, column.components,
                         column.components.size() == 1 ? 1 : 3);
  }
  add_field_data(header);
}

/// The arrays by which VTK knows that every point is a cell of its own.
void SnapshotLayout::add_cells() {
  add_single_value("/VTKHDF/NumberOfPoints", "1", "number of particles", Hdf5Type::int64, total_);
  add_single_value("/VTKHDF/NumberOfCells", "1", "number of cells, one vertex a particle", Hdf5Type::int64, total_);
  add_single_value("/VTKHDF/NumberOfConnectivityIds", "1", "length of Connectivity", Hdf5Type::int64, total_);
  datasets_.push_back({"/VTKHDF/Types", "1", "VTK cell type: 1, vertex", Hdf5Type::uint8, total_, 1,
                       by_id_.part_count(), [this](int part, std::vector<std::byte>& bytes) {
                         const RowBlock rows = by_id_.part(part);
                         bytes.assign(static_cast<std::size_t>(rows.size()), std::byte{vtk_vertex});
                         return rows.first;
                       }});
  add_numbered("/VTKHDF/Connectivity", "the point of each cell", total_);
  add_numbered("/VTKHDF/Offsets", "where each cell begins in Connectivity", total_ + 1);
}

void SnapshotLayout::add_field_data(const SnapshotHeader& header) {
  add_single_value("/VTKHDF/FieldData/TimeValue", "s", "time", Hdf5Type::float64, header.time);
  add_single_value("/VTKHDF/FieldData/step", "1", "number of the step", Hdf5Type::int64, header.step);
  add_single_value("/VTKHDF/FieldData/state_hash", "1", "hash of the state", Hdf5Type::uint64, header.state_hash);
}

void SnapshotLayout::add_numbered(std::string path, std::string description, std::int64_t total_rows) {
  const bool is_last_rank = communicator_.rank() == communicator_.size() - 1;
  datasets_.push_back({std::move(path), "1", std::move(description), Hdf5Type::int64, total_rows, 1,
                       by_id_.part_count(), [this, total_rows, is_last_rank](int part, std::vector<std::byte>& bytes) {
                         RowBlock rows = by_id_.part(part);
                         // Rows that no particle has.
                         if (is_last_rank && part == by_id_.part_count() - 1) rows.end = total_rows;
                         const auto count = static_cast<std::size_t>(rows.size());
                         bytes.resize(count * sizeof(std::int64_t));
                         for (std::size_t k = 0; k < count; ++k) {
                           const std::int64_t number = rows.first + static_cast<std::int64_t>(k);
                           std::memcpy(bytes.data() + k * sizeof(number), &number, sizeof(number));
                         }
                         return rows.first;
                       }});
}

/// Rows of `width` numbers; missing components are zero.
template <class T>
void SnapshotLayout::add_column(std::string path, const std::string& unit, const std::string& description,
                                Hdf5Type type, std::span<const Pieces<T>> components, int width) {
  // Held by value: those of the position are no column's.
  std::vector<Pieces<T>> sources(components.begin(), components.end());
  const auto numbers = static_cast<std::size_t>(width);
  datasets_.push_back({std::move(path), unit, description, type, total_, width, by_id_.part_count(),
                       [this, sources = std::move(sources), numbers](int part, std::vector<std::byte>& bytes) {
                         const RowBlock rows = by_id_.part(part);
                         const auto count = static_cast<std::size_t>(rows.size());
                         constexpr std::size_t number = sizeof(std::uint64_t);
                         bytes.resize(count * numbers * number);
                         if (numbers == 1) {
                           by_id_.gather(part, sources.front(), bytes.data());
                           return rows.first;
                         }
                         std::fill(bytes.begin(), bytes.end(), std::byte{0});
                         values_.resize(count);
                         for (std::size_t c = 0; c < sources.size(); ++c) {
                           by_id_.gather(part, sources[c], std::as_writable_bytes(std::span(values_)).data());
                           for (std::size_t row = 0; row < count; ++row)
                             std::memcpy(bytes.data() + (row * numbers + c) * number, &values_[row], number);
                         }
                         return rows.first;
                       }});
}

/// A dataset of a single value, which rank 0 writes.
template <class T>
void SnapshotLayout::add_single_value(std::string path, std::string unit, std::string description, Hdf5Type type,
                                      T value) {
  const bool writes = communicator_.rank() == 0;
  datasets_.push_back({std::move(path), std::move(unit), std::move(description), type, 1, 1, 1,
                       [value, writes](int, std::vector<std::byte>& bytes) {
                         const auto all = std::as_bytes(std::span(&value, writes ? 1 : 0));
                         bytes.assign(all.begin(), all.end());
                         return std::int64_t{0};
                       }});
}

}  // namespace sphdrop
