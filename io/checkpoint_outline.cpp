#include "io/checkpoint_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "io/checkpoint_head.hpp"

namespace sphdrop {
namespace {

constexpr std::string_view about =
    "State of a simulation by sphdrop, to go on from. /case: the case as it was run. /<table>/<column>: row k belongs "
    "to the particle with the id first_id + k. /run: numbers of the whole run. All in SI units, the attribute time "
    "in s; the unit - stands for several, which the description names. state_hash: of the tables as they are here.";

std::string format_name() {
  return fmt::format("sphdrop checkpoint {}", checkpoint_format);
}

std::uint64_t parse_hash(const std::filesystem::path& path, const std::string& text) {
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (error != std::errc() || end != text.data() + text.size() || text.size() != 16) {
    throw CheckpointError(fmt::format("{} is malformed: its state_hash is '{}'", path.string(), text));
  }
  return hash;
}

CheckpointHeader read_header(const Hdf5File& file, const std::filesystem::path& path) {
  const std::string format = file.read_text_attribute("/", "format");
  if (format != format_name()) {
    throw CheckpointError(fmt::format("{} is malformed: its format is '{}'", path.string(), format));
  }
  CheckpointHeader header;
  header.name = file.read_text_attribute("/", "name");
  header.version = file.read_text_attribute("/", "version");
  header.git_commit = file.read_text_attribute("/", "git_commit");
  header.time = file.read_real_attribute("/", "time");
  header.step = file.read_integer_attribute("/", "step");
  header.state_hash = parse_hash(path, file.read_text_attribute("/", "state_hash"));
  header.case_text = file.read_text("/case");
  return header;
}

/// Opens a one-dimensional dataset of doubles.
Hdf5Dataset open_reals(const Hdf5File& file, const std::filesystem::path& path, const std::string& name) {
  Hdf5Dataset dataset = file.open_dataset(name, Hdf5Type::float64);
  if (dataset.components() != 1 || !dataset.is_stored_as_opened()) {
    throw CheckpointError(fmt::format("{} is malformed: {} is not an array of doubles", path.string(), name));
  }
  return dataset;
}

Checkpoint::Table read_table(const Hdf5File& file, const std::filesystem::path& path, const std::string& name) {
  const std::string group = "/" + name;
  Checkpoint::Table table;
  table.name = name;
  table.total_rows = file.read_integer_attribute(group, "rows");
  table.first_id = file.read_integer_attribute(group, "first_id");
  for (const std::string& column : file.datasets_in(group)) {
    const std::string full_name = fmt::format("{}/{}", group, column);
    const std::int64_t rows = open_reals(file, path, full_name).rows();
    if (rows != table.total_rows) {
      throw CheckpointError(fmt::format("{} is malformed: {} has {} rows, but its table has {}", path.string(),
                                        full_name, rows, table.total_rows));
    }
    table.columns.push_back(
        {column, file.read_text_attribute(full_name, "unit"), file.read_text_attribute(full_name, "description"), {}});
  }
  return table;
}

}  // namespace

void write_outline(Hdf5File& file, const CheckpointHeader& header, std::span<const TableOutline> tables,
                   std::span<const CheckpointNumbers> numbers) {
  file.write_attribute("/", "format", std::string_view(format_name()));
  file.write_attribute("/", "about", about);
  file.write_attribute("/", "name", std::string_view(header.name));
  file.write_attribute("/", "version", std::string_view(header.version));
  file.write_attribute("/", "git_commit", std::string_view(header.git_commit));
  file.write_attribute("/", "time", header.time);
  file.write_attribute("/", "step", header.step);
  file.write_attribute("/", "state_hash", std::string_view(fmt::format("{:016x}", header.state_hash)));
  file.write_text("/case", header.case_text);
  file.create_group("/run");
  for (const CheckpointNumbers& entry : numbers) {
    const std::string name = "/run/" + entry.name;
    const std::int64_t count = std::ssize(entry.values);
    file.create_dataset(name, Hdf5Type::float64, count, 1).write_rows(0, count, entry.values.data());
    file.write_attribute(name, "unit", std::string_view(entry.unit));
    file.write_attribute(name, "description", std::string_view(entry.description));
  }
  for (const TableOutline& table : tables) {
    const std::string group = "/" + table.name;
    file.create_group(group);
    file.write_attribute(group, "rows", table.total_rows);
    file.write_attribute(group, "first_id", table.first_id);
  }
}

Checkpoint read_outline(const Hdf5File& file, const std::filesystem::path& path) {
  Checkpoint checkpoint;
  checkpoint.path = path;
  const std::vector<std::string> groups = file.groups_in("/");
  const std::vector<std::string> datasets = file.datasets_in("/");
  const auto lacks = [](const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) == names.end();
  };
  if (lacks(datasets, "case")) throw CheckpointError(path.string() + " is malformed: it lacks /case");
  if (lacks(groups, "run")) throw CheckpointError(path.string() + " is malformed: it lacks /run");
  checkpoint.header = read_header(file, path);
  for (const std::string& name : groups) {
    if (name != "run") checkpoint.tables.push_back(read_table(file, path, name));
  }
  for (const std::string& name : file.datasets_in("/run")) {
    const std::string full_name = "/run/" + name;
    const Hdf5Dataset dataset = open_reals(file, path, full_name);
    CheckpointNumbers entry{name, file.read_text_attribute(full_name, "unit"),
                            file.read_text_attribute(full_name, "description"),
                            std::vector<double>(static_cast<std::size_t>(dataset.rows()))};
    dataset.read_rows(0, dataset.rows(), entry.values.data());
    checkpoint.numbers.push_back(std::move(entry));
  }
  return checkpoint;
}

std::int64_t outline_bytes(const CheckpointHeader& header, std::span<const CheckpointNumbers> numbers) {
  std::int64_t bytes = std::ssize(header.case_text);
  // 2 KiB for what HDF5 files with each of them.
  for (const CheckpointNumbers& entry : numbers) bytes += 8 * std::ssize(entry.values) + 2048;
  return bytes;
}

}  // namespace sphdrop
