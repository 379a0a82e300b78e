#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/checkpoint.hpp"
#include "io/checkpoint_outline.hpp"
#include "io/collective_error.hpp"
#include "io/hdf5_file.hpp"
#include "io/rows_by_id.hpp"

namespace sphdrop {
namespace {

/// Whoever has `name`; CheckpointError if nobody has.
template <class Named>
const Named& find_named(const Checkpoint& checkpoint, const std::vector<Named>& all, std::string_view name,
                        std::string_view group) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  if (found == all.end()) throw CheckpointError(fmt::format("{} lacks {}{}", checkpoint.path.string(), group, name));
  return *found;
}

void read_rows(const Hdf5File& file, const Communicator& communicator, Checkpoint::Table& table) {
  const RowBlock share = RowBlock::of_rank(table.total_rows, communicator.rank(), communicator.size());
  table.first_id += share.first;
  table.row_count = share.size();
  for (Checkpoint::Column& column : table.columns) {
    column.values.resize(static_cast<std::size_t>(share.size()));
    file.open_dataset("/" + table.name + "/" + column.name, Hdf5Type::float64)
        .read_rows(share.first, share.size(), column.values.data());
  }
}

/// Rank 0's list, as the directory may look different to others.
std::vector<std::filesystem::path> find_collectively(const Communicator& communicator,
                                                     const std::filesystem::path& directory) {
  std::string names;
  if (communicator.rank() == 0) {
    for (const auto& path : find_checkpoints(directory)) names += path.filename().string() + '/';
  }
  communicator.broadcast(names, 0);
  std::vector<std::filesystem::path> paths;
  for (std::size_t start = 0; start < names.size();) {
    const std::size_t end = names.find('/', start);
    paths.push_back(directory / names.substr(start, end - start));
    start = end + 1;
  }
  return paths;
}

}  // namespace

const Checkpoint::Table& Checkpoint::table(std::string_view name) const {
  return find_named(*this, tables, name, "/");
}

const std::vector<double>& Checkpoint::column(std::string_view table_name, std::string_view name) const {
  return find_named(*this, table(table_name).columns, name, fmt::format("/{}/", table_name)).values;
}

const std::vector<double>& Checkpoint::numbers_of(std::string_view name) const {
  return find_named(*this, numbers, name, "/run/").values;
}

Checkpoint read_checkpoint(const Communicator& communicator, const std::filesystem::path& path) {
  verify_checkpoint(communicator, path);
  Checkpoint checkpoint;
  collectively<CheckpointError>(communicator, [&] {
    const Hdf5File file = Hdf5File::open_to_read(path.string());
    checkpoint = read_outline(file, path);
    for (Checkpoint::Table& table : checkpoint.tables) read_rows(file, communicator, table);
  });
  return checkpoint;
}

LatestCheckpoint read_latest_checkpoint(const Communicator& communicator, const std::filesystem::path& directory) {
  LatestCheckpoint latest;
  const auto paths = find_collectively(communicator, directory);
  for (const auto& path : paths) {
    try {
      latest.checkpoint = read_checkpoint(communicator, path);
      return latest;
    } catch (const CheckpointError& error) {
      latest.refused.emplace_back(error.what());
      latest.checkpoint = {};
    }
  }
  if (paths.empty()) throw CheckpointError(fmt::format("there is no checkpoint in '{}'", directory.string()));
  throw CheckpointError(
      fmt::format("no checkpoint in '{}' can be used: {}", directory.string(), fmt::join(latest.refused, "; ")));
}

}  // namespace sphdrop
