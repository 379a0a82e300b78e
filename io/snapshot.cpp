#include "io/snapshot.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <utility>

#include "io/collective_error.hpp"
#include "io/hdf5_file.hpp"
#include "io/posix_file.hpp"
#include "io/snapshot_layout.hpp"

namespace sphdrop {
namespace {

/// HDF5's own structures: superblock, groups, object headers, attributes. A kilobyte or two a dataset.
constexpr std::int64_t metadata_allowance = 1 << 20;

std::int64_t bytes_needed(std::span<const SnapshotDataset> datasets) {
  std::int64_t bytes = metadata_allowance;
  for (const SnapshotDataset& dataset : datasets) bytes += dataset.total_bytes();
  return bytes;
}

void write_structure(const std::string& path, const SnapshotHeader& header, std::span<const SnapshotDataset> datasets) {
  Hdf5File file = Hdf5File::create(path);
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
  for (const SnapshotDataset& dataset : datasets) {
    file.create_dataset(dataset.path, dataset.type, dataset.total_rows, dataset.components);
    file.write_attribute(dataset.path, "unit", std::string_view(dataset.unit));
    file.write_attribute(dataset.path, "description", std::string_view(dataset.description));
  }
  file.close();
}

/// A full disk must show before anything is written: with HDF5 it may show as success, and with MPI-IO as a hang.
/// Creating the file gives back what was reserved before, so the space is taken again for the values.
void prepare_file(const std::string& path, const SnapshotHeader& header, std::span<const SnapshotDataset> datasets) {
  const std::int64_t bytes = bytes_needed(datasets);
  FileDescriptor(path, O_WRONLY | O_CREAT | O_TRUNC).close();
  reserve_space(path, bytes);
  write_structure(path, header, datasets);
  reserve_space(path, bytes);
}

/// Whether the start of the file can be written again (with the same bytes).
bool can_be_rewritten(const std::string& path) {
  try {
    FileDescriptor file(path, O_RDWR);
    file.rewrite_start(96);
    file.close();
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

/// At closing, HDF5 writes the superblock again. Should that fail, the rank that fails and the others wait for each
/// other in H5Fclose for ever; so every rank tries it first. (That all values were written without an error says
/// nothing: from three ranks on, Open MPI's OMPIO reports success for writes that failed.)
void stop_unless_closable(const Communicator& communicator, const std::string& path, const std::string& earlier_error) {
  if (communicator.min(std::int64_t{can_be_rewritten(path) ? 1 : 0}) == 1) return;
  if (communicator.rank() == 0) {
    fmt::print(stderr, "error: {}: the file can be neither written nor closed; stopping. {}\n", path, earlier_error);
    std::fflush(stderr);
  }
  communicator.barrier();
  MPI_Abort(communicator.handle(), EXIT_FAILURE);
}

void write_values(const Communicator& communicator, const std::string& path,
                  std::span<const SnapshotDataset> datasets) {
  std::optional<Hdf5File> file;
  collectively<SnapshotError>(communicator, [&] { file.emplace(Hdf5File::open_collectively(communicator, path)); });
  try {
    for (const SnapshotDataset& data : datasets) {
      std::optional<Hdf5Dataset> dataset;
      collectively<SnapshotError>(communicator, [&] { dataset.emplace(file->open_dataset(data.path, data.type)); });
      collectively<SnapshotError>(
          communicator, [&] { dataset->write_rows_collectively(data.first_row, data.row_count(), data.bytes.data()); });
    }
  } catch (const SnapshotError& error) {
    stop_unless_closable(communicator, path, error.what());
    throw;
  }
  stop_unless_closable(communicator, path, "");
  file->close();
}

/// Collective MPI-IO on a full or broken disk may report success; what the file holds is what counts.
void compare_with_file(const std::string& path, std::span<const SnapshotDataset> datasets) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  std::vector<std::byte> bytes;
  for (const SnapshotDataset& data : datasets) {
    const Hdf5Dataset dataset = file.open_dataset(data.path, data.type);
    if (dataset.rows() != data.total_rows || dataset.components() != data.components) {
      throw Hdf5Error(fmt::format("{}:{} has the wrong shape when read back", path, data.path));
    }
    bytes.resize(data.bytes.size());
    dataset.read_rows(data.first_row, data.row_count(), bytes.data());
    if (bytes != data.bytes) {
      throw Hdf5Error(fmt::format("{}:{} does not hold what was written (full or faulty disk?)", path, data.path));
    }
  }
}

}  // namespace

SnapshotColumn SnapshotColumn::scalar(std::string name, std::string unit, std::string description,
                                      std::span<const double> values) {
  return {std::move(name), std::move(unit), std::move(description), {values}, {}};
}

SnapshotColumn SnapshotColumn::vector(std::string name, std::string unit, std::string description,
                                      std::span<const double> x, std::span<const double> y) {
  return {std::move(name), std::move(unit), std::move(description), {x, y}, {}};
}

SnapshotColumn SnapshotColumn::integer(std::string name, std::string description,
                                       std::span<const std::int64_t> values) {
  return {std::move(name), "1", std::move(description), {}, values};
}

void write_snapshot(const Communicator& communicator, const std::filesystem::path& path, const SnapshotHeader& header,
                    const SnapshotRows& rows, std::span<const SnapshotColumn> columns) {
  const std::vector<SnapshotDataset> datasets = lay_out_snapshot(communicator, header, rows, columns);
  const bool is_root = communicator.rank() == 0;
  const std::string part = path.string() + ".part";
  try {
    collectively<SnapshotError>(communicator, [&] {
      if (is_root) prepare_file(part, header, datasets);
    });
    write_values(communicator, part, datasets);
    collectively<SnapshotError>(communicator, [&] {
      if (!is_root) return;
      release_unused_space(part);
      synchronise_file(part);
    });
    collectively<SnapshotError>(communicator, [&] { compare_with_file(part, datasets); });
    collectively<SnapshotError>(communicator, [&] {
      if (is_root) rename_durably(part, path);
    });
  } catch (const SnapshotError& error) {
    // All ranks are here, and all have closed the file.
    std::error_code ignored;
    if (is_root) std::filesystem::remove(part, ignored);
    throw SnapshotError(fmt::format("the snapshot {} could not be written: {}", path.string(), error.what()));
  }
}

}  // namespace sphdrop
