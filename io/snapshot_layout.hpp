#pragma once
// A snapshot's datasets as this rank writes them: VTKHDF 1.0, UnstructuredGrid, one vertex cell a particle.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/durable_hdf5.hpp"
#include "io/rows_by_id.hpp"
#include "io/snapshot.hpp"

namespace sphdrop {

/// The datasets refer to it and to the columns.
class SnapshotLayout {
 public:
  /// Collective. Throws CollectiveError if the rows or columns are not what SnapshotRows and SnapshotColumn say.
  SnapshotLayout(const Communicator& communicator, const SnapshotHeader& header, const SnapshotRows& rows,
                 std::span<const SnapshotColumn> columns);
  SnapshotLayout(const SnapshotLayout&) = delete;
  SnapshotLayout& operator=(const SnapshotLayout&) = delete;

  std::span<const DatasetRows> datasets() const { return datasets_; }

 private:
  void add_cells();
  void add_field_data(const SnapshotHeader& header);
  /// What becomes of the number of a row.
  void add_numbered(std::string path, std::string description, std::int64_t total_rows);
  template <class T>
  void add_column(std::string path, const std::string& unit, const std::string& description, Hdf5Type type,
                  std::span<const Pieces<T>> components, int width);
  template <class T>
  void add_single_value(std::string path, std::string unit, std::string description, Hdf5Type type, T value);

  const Communicator& communicator_;
  std::int64_t total_;
  RowsById by_id_;
  std::vector<std::uint64_t> values_;  ///< of a component
  std::vector<DatasetRows> datasets_;
};

}  // namespace sphdrop
