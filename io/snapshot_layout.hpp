#pragma once
// A snapshot's datasets as this rank writes them: VTKHDF 1.0, UnstructuredGrid, one vertex cell a particle.

#include <span>
#include <vector>

#include "io/durable_hdf5.hpp"
#include "io/snapshot.hpp"

namespace sphdrop {

/// Collective: brings the columns into the order of ids. Throws CollectiveError if the rows or columns are not
/// what SnapshotRows and SnapshotColumn say.
std::vector<DatasetRows> lay_out_snapshot(const Communicator& communicator, const SnapshotHeader& header,
                                          const SnapshotRows& rows, std::span<const SnapshotColumn> columns);

}  // namespace sphdrop
