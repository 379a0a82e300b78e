#include "io/durable_hdf5.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>
#include <system_error>
#include <vector>

#include "io/collective_error.hpp"
#include "io/file_checksum.hpp"
#include "io/memory_file.hpp"
#include "io/posix_file.hpp"

namespace sphdrop {
namespace {

/// HDF5's own structures: superblock, groups, object headers, attributes. A kilobyte or two a dataset.
constexpr std::int64_t metadata_allowance = 1 << 20;

/// HDF5's superblock with what belongs to it.
constexpr std::size_t superblock_bytes = 96;

std::int64_t bytes_needed(const DurableHdf5& plan) {
  std::int64_t bytes = metadata_allowance + plan.user_block + plan.structure_bytes;
  for (const DatasetRows& dataset : plan.datasets) bytes += dataset.total_bytes();
  return bytes;
}

MemoryFile make_structure(const std::string& path, const DurableHdf5& plan) {
  MemoryFile memory;
  Hdf5File file = Hdf5File::create(path, plan.user_block);
  file.redirect(memory.descriptor());
  plan.write_structure(file);
  for (const DatasetRows& dataset : plan.datasets) {
    file.create_dataset(dataset.path, dataset.type, dataset.total_rows, dataset.components);
    file.write_attribute(dataset.path, "unit", std::string_view(dataset.unit));
    file.write_attribute(dataset.path, "description", std::string_view(dataset.description));
  }
  file.close();
  return memory;
}

/// A full disk must show before anything is written: with HDF5 it may show as success, and with MPI-IO as a hang. The
/// structure is made in memory, since a file that HDF5 cannot write crashes it at the end of the program.
void prepare_file(const std::string& path, const DurableHdf5& plan) {
  const MemoryFile structure = make_structure(path, plan);
  reserve_space(path, bytes_needed(plan));
  FileDescriptor file(path, O_WRONLY);
  structure.copy_to(file);
  file.close();
}

/// Whether the superblock can be written again (with the same bytes).
bool can_be_rewritten(const std::string& path, std::int64_t user_block) {
  try {
    FileDescriptor file(path, O_RDWR);
    file.rewrite(user_block, superblock_bytes);
    file.close();
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

/// At closing, HDF5 writes the superblock again. Should that fail, the rank that fails and the others wait for each
/// other in H5Fclose for ever; so every rank tries it first. (That all values were written without an error says
/// nothing: from three ranks on, Open MPI's OMPIO reports success for writes that failed.)
void stop_unless_closable(const Communicator& communicator, const std::string& path, std::int64_t user_block,
                          const std::string& earlier_error) {
  if (communicator.min(std::int64_t{can_be_rewritten(path, user_block) ? 1 : 0}) == 1) return;
  if (communicator.rank() == 0) {
    fmt::print(stderr, "error: {}: the file can be neither written nor closed; stopping. {}\n", path, earlier_error);
    std::fflush(stderr);
  }
  communicator.barrier();
  MPI_Abort(communicator.handle(), unwritable_output_exit_code);
}

/// Consecutive rows of a dataset as they were written.
struct WrittenRows {
  const DatasetRows* dataset;
  std::int64_t first_row, row_count;
  Digest digest;  ///< of their bytes
};

/// Part by part, as all of the values at once would be as much memory as the columns themselves.
std::vector<WrittenRows> write_parts(const Communicator& communicator, const Hdf5File& file,
                                     std::span<const DatasetRows> datasets) {
  std::vector<Hdf5Dataset> opened;
  collectively<CollectiveError>(communicator, [&] {
    for (const DatasetRows& data : datasets) opened.push_back(file.open_dataset(data.path, data.type));
  });
  int part_count = 0;
  for (const DatasetRows& data : datasets) part_count = std::max(part_count, data.part_count);
  std::vector<WrittenRows> written;
  std::vector<std::byte> bytes;
  for (int part = 0; part < part_count; ++part)
    for (std::size_t k = 0; k < datasets.size(); ++k) {
      const DatasetRows& data = datasets[k];
      if (part >= data.part_count) continue;
      const std::int64_t first_row = data.take_part(part, bytes);
      const auto row_count = static_cast<std::int64_t>(bytes.size() / data.row_bytes());
      written.push_back({&data, first_row, row_count, digest_of(bytes)});
      collectively<CollectiveError>(communicator,
                                    [&] { opened[k].write_rows_collectively(first_row, row_count, bytes.data()); });
    }
  return written;
}

std::vector<WrittenRows> write_values(const Communicator& communicator, const std::string& path,
                                      const DurableHdf5& plan) {
  std::optional<Hdf5File> file;
  // Where only some of the ranks can open the file, Open MPI hangs.
  collectively<CollectiveError>(communicator, [&] { FileDescriptor(path, O_RDWR).close(); });
  collectively<CollectiveError>(communicator, [&] { file.emplace(Hdf5File::open_collectively(communicator, path)); });
  std::vector<WrittenRows> written;
  try {
    written = write_parts(communicator, *file, plan.datasets);
  } catch (const CollectiveError& error) {
    stop_unless_closable(communicator, path, plan.user_block, error.what());
    throw;
  }
  stop_unless_closable(communicator, path, plan.user_block, "");
  file->close();
  return written;
}

/// Collective MPI-IO on a full or broken disk may report success; what the file holds is what counts. What was written
/// is known by its digests: two of 128 bits are not the same by chance.
void compare_with_file(const std::string& path, std::span<const WrittenRows> written) {
  const Hdf5File file = Hdf5File::open_to_read(path);
  std::vector<std::byte> bytes;
  for (const WrittenRows& rows : written) {
    const DatasetRows& data = *rows.dataset;
    const Hdf5Dataset dataset = file.open_dataset(data.path, data.type);
    if (dataset.rows() != data.total_rows || dataset.components() != data.components) {
      throw Hdf5Error(fmt::format("{}:{} has the wrong shape when read back", path, data.path));
    }
    bytes.resize(static_cast<std::size_t>(rows.row_count) * data.row_bytes());
    dataset.read_rows(rows.first_row, rows.row_count, bytes.data());
    if (digest_of(bytes) != rows.digest) {
      throw Hdf5Error(fmt::format("{}:{} does not hold what was written (full or faulty disk?)", path, data.path));
    }
  }
}

}  // namespace

bool is_dataset_name(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

void write_hdf5_durably(const Communicator& communicator, const std::filesystem::path& path, const DurableHdf5& plan) {
  const bool is_root = communicator.rank() == 0;
  const std::string part = path.string() + ".part";
  try {
    collectively<CollectiveError>(communicator, [&] {
      if (is_root) prepare_file(part, plan);
    });
    const std::vector<WrittenRows> written = write_values(communicator, part, plan);
    if (plan.seal) plan.seal(part);
    collectively<CollectiveError>(communicator, [&] {
      if (!is_root) return;
      release_unused_space(part);
      synchronise_file(part);
    });
    if (plan.verify) plan.verify(part);
    collectively<CollectiveError>(communicator, [&] { compare_with_file(part, written); });
    collectively<CollectiveError>(communicator, [&] {
      if (is_root) rename_durably(part, path);
    });
  } catch (const CollectiveError&) {
    // All ranks are here, and all have closed the file.
    std::error_code ignored;
    if (is_root) std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace sphdrop
