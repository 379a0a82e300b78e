#include "io/snapshot.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/collective_error.hpp"
#include "io/durable_hdf5.hpp"
#include "io/snapshot_layout.hpp"

namespace sphdrop {
namespace {

void write_structure(Hdf5File& file, const SnapshotHeader& header) {
  file.write_attribute("/", "format", std::string_view("sphdrop snapshot 1"));
  file.write_attribute("/", "name", std::string_view(header.name));
  file.write_attribute("/", "version", std::string_view(header.version));
  file.write_attribute("/", "time", header.time);
  file.write_attribute("/", "step", header.step);
  file.write_attribute("/", "state_hash", std::string_view(fmt::format("{:016x}", header.state_hash)));
  file.create_group("/VTKHDF");
  const std::array<std::int64_t, 2> version = {1, 0};
  file.write_attribute("/VTKHDF", "Version", version);
  file.write_attribute("/VTKHDF", "Type", std::string_view("UnstructuredGrid"));
  file.create_group("/VTKHDF/PointData");
  file.create_group("/VTKHDF/FieldData");
}

}  // namespace

SnapshotColumn SnapshotColumn::scalar(std::string name, std::string unit, std::string description,
                                      Pieces<double> values) {
  return {std::move(name), std::move(unit), std::move(description), {std::move(values)}, {}};
}

SnapshotColumn SnapshotColumn::vector(std::string name, std::string unit, std::string description, Pieces<double> x,
                                      Pieces<double> y) {
  return {std::move(name), std::move(unit), std::move(description), {std::move(x), std::move(y)}, {}};
}

SnapshotColumn SnapshotColumn::integer(std::string name, std::string description, Pieces<std::int64_t> values) {
  return {std::move(name), "1", std::move(description), {}, std::move(values)};
}

void write_snapshot(const Communicator& communicator, const std::filesystem::path& path, const SnapshotHeader& header,
                    const SnapshotRows& rows, std::span<const SnapshotColumn> columns) {
  try {
    SnapshotLayout layout(communicator, header, rows, columns);
    DurableHdf5 plan;
    plan.write_structure = [&](Hdf5File& file) { write_structure(file, header); };
    plan.datasets = layout.datasets();
    write_hdf5_durably(communicator, path, plan);
  } catch (const CollectiveError& error) {
    throw SnapshotError(fmt::format("the snapshot {} could not be written: {}", path.string(), error.what()));
  }
}

}  // namespace sphdrop
