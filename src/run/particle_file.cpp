#include "run/particle_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <string_view>
#include <system_error>

#include "config/parameter_text.hpp"
#include "config/quantity.hpp"
#include "io/column_table.hpp"
#include "io/file_checksum.hpp"
#include "io/output_directory.hpp"
#include "io/posix_file.hpp"

namespace sphdrop {
namespace {

struct KnownColumn {
  std::string_view name, unit, quantity;
};
constexpr std::array known_columns = {KnownColumn{"x", "m", "a length"}, KnownColumn{"y", "m", "a length"},
                                      KnownColumn{"vx", "m/s", "a speed"}, KnownColumn{"vy", "m/s", "a speed"},
                                      KnownColumn{"mass", "kg/m", "a mass per length"}};

[[noreturn]] void refuse(const std::string& text) {
  throw ParticleFileError(text, true);
}

std::string bytes_of(const std::string& path) {
  try {
    const FileDescriptor file(path, O_RDONLY);
    std::string content(static_cast<std::size_t>(file.size()), '\0');
    file.read_at(0, std::as_writable_bytes(std::span(content)));
    return content;
  } catch (const std::system_error& error) {
    throw ParticleFileError(fmt::format("cannot be read: {} ({})", error.code().message(), path), false);
  }
}

ColumnTable hdf5_table(const std::string& path, const std::string& file, bool is_snapshot) {
  const std::vector<Hdf5Columns> of_snapshot = {{"/VTKHDF/Points", {"x", "y"}, true},
                                                {"/VTKHDF/PointData/velocity", {"vx", "vy"}, true},
                                                {"/VTKHDF/PointData/mass", {"mass"}, true},
                                                {"/VTKHDF/PointData/material", {"material"}, true}};
  const std::vector<Hdf5Columns> plain = {
      {"/position", {"x", "y"}, true}, {"/velocity", {"vx", "vy"}}, {"/mass", {"mass"}}};
  return read_hdf5_table(path, file, is_snapshot ? of_snapshot : plain);
}

/// Leaves the drop of a snapshot.
void leave_out_solid(ColumnTable& table) {
  const std::vector<double> material = table.find("material")->values;
  for (ColumnTable::Column& column : table.columns) {
    std::vector<double> kept;
    for (std::size_t k = 0; k < material.size(); ++k)
      if (material[k] == 0) kept.push_back(column.values[k]);
    column.values = std::move(kept);
  }
}

/// In SI units; empty where there is no such column.
std::vector<double> values_of(const ColumnTable& table, const std::string& file, std::string_view name) {
  const ColumnTable::Column* column = table.find(name);
  if (column == nullptr) return {};
  if (column->unit.empty()) return column->values;
  const KnownColumn* known = known_columns.data();
  while (known->name != name) ++known;
  if (!parse_quantity("1 " + column->unit, known->unit).value)
    refuse(
        fmt::format("{}:{}: the column {} is {} and cannot be in [{}]; its unit is {}, with a prefix or without, and "
                    "that is meant where none stands",
                    file, table.header_line, name, known->quantity, column->unit, known->unit));
  std::vector<double> values;
  for (std::size_t k = 0; k < column->values.size(); ++k) {
    const Quantity quantity =
        parse_quantity(fmt::format("{} {}", number_text(column->values[k]), column->unit), known->unit);
    if (!quantity.value) refuse(fmt::format("{}:{}: {} {}", file, table.lines[k], name, quantity.mistake));
    values.push_back(*quantity.value);
  }
  return values;
}

void check(const GivenParticles& given, const ColumnTable& table) {
  constexpr double farthest = 100;  // m; as far as a case may put a drop
  const std::string header = table.header_line > 0 ? fmt::format("{}:{}", given.file, table.header_line) : given.file;
  if (given.size() == 0) refuse(fmt::format("{}: holds no particles", given.file));
  if (given.velocity_x.size() != given.velocity_y.size())
    refuse(fmt::format("{}: has one of the columns vx and vy; give both or none", header));
  for (std::size_t k = 0; k < given.size(); ++k) {
    for (const double coordinate : {given.x[k], given.y[k]})
      if (std::abs(coordinate) > farthest)
        refuse(fmt::format("{}: a place {:g} m away is beyond all cases ({:g} m)", given.place_of(k), coordinate,
                           farthest));
    if (!given.mass.empty() && !(given.mass[k] > 0))
      refuse(fmt::format("{}: mass = {:g} kg/m must be > 0", given.place_of(k), given.mass[k]));
  }
}

std::string copy_name(std::size_t drop, bool is_hdf5_file) {
  return fmt::format("case_drop_{}.{}", drop + 1, is_hdf5_file ? "h5" : "csv");
}

/// Of the first folder that has one; empty if none has.
std::filesystem::path copy_in(const CopyFolders& folders, std::size_t drop) {
  for (const std::filesystem::path& folder : folders)
    for (const bool is_hdf5_file : {false, true}) {
      std::filesystem::path copy = folder / copy_name(drop, is_hdf5_file);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(copy, ignored)) return copy;
    }
  return {};
}

std::string readable_path(const ParticleRequest& request, const CopyFolders& folders) {
  std::error_code ignored;
  if (std::filesystem::exists(request.path, ignored)) return request.path;
  const std::filesystem::path copy = copy_in(folders, request.drop);
  if (copy.empty()) return request.path;
  fmt::print(stderr, "note: {} is not there; its copy {} is taken\n", request.path, copy.string());
  return copy.string();
}

}  // namespace

std::shared_ptr<const GivenParticles> read_particle_file(const std::string& path, const std::string& file) {
  auto given = std::make_shared<GivenParticles>();
  given->file = file;
  given->path = std::filesystem::absolute(path).lexically_normal().string();
  std::error_code is_told_below;
  const std::filesystem::file_status status = std::filesystem::status(path, is_told_below);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw ParticleFileError(fmt::format("is a {}, not a file ({})",
                                        std::filesystem::is_directory(status) ? "folder" : "pipe or device", path),
                            false);
  given->content = bytes_of(path);
  given->checksum = hexadecimal(digest_of(std::string_view(given->content)));
  try {
    ColumnTable table;
    if (is_hdf5(given->content)) {
      const bool is_snapshot = has_hdf5_group(path, file, "/VTKHDF");
      table = hdf5_table(path, file, is_snapshot);
      if (is_snapshot) leave_out_solid(table);
    } else {
      if (given->content.starts_with("sphdrop checkpoint"))
        refuse(fmt::format("{}: is a checkpoint; take a snapshot, which holds the drop too", file));
      std::vector<std::string_view> names;
      names.reserve(known_columns.size());
      for (const KnownColumn& known : known_columns) names.push_back(known.name);
      table = parse_text_table(given->content, file, names);
    }
    for (const std::string_view name : {"x", "y"})
      if (table.find(name) == nullptr)
        refuse(fmt::format("{}:{}: has no column {}; the first line must name x and y", file, table.header_line, name));
    given->x = values_of(table, file, "x");
    given->y = values_of(table, file, "y");
    given->velocity_x = values_of(table, file, "vx");
    given->velocity_y = values_of(table, file, "vy");
    given->mass = values_of(table, file, "mass");
    given->lines = table.lines;
    check(*given, table);
  } catch (const TableError& error) {
    refuse(error.what());
  }
  return given;
}

std::shared_ptr<const GivenParticles> shared_particles(const Communicator& communicator, const ParticleRequest& request,
                                                       const CopyFolders& folders) {
  auto given = std::make_shared<GivenParticles>();
  std::string mistake;
  std::vector<char> is_located{0};
  if (communicator.rank() == 0) {
    try {
      const std::string path = readable_path(request, folders);
      *given = *read_particle_file(path, path);
    } catch (const ParticleFileError& error) {
      mistake = error.what();
      is_located[0] = error.is_located ? 1 : 0;
    } catch (const std::exception& error) {
      mistake = fmt::format("cannot be read: {}", error.what());
    }
  }
  communicator.broadcast(mistake, 0);
  communicator.broadcast(is_located, 0);
  if (!mistake.empty()) throw ParticleFileError(mistake, is_located[0] != 0);
  for (std::string* text : {&given->file, &given->path, &given->checksum}) communicator.broadcast(*text, 0);
  for (std::vector<double>* column : {&given->x, &given->y, &given->velocity_x, &given->velocity_y, &given->mass})
    communicator.broadcast(*column, 0);
  communicator.broadcast(given->lines, 0);
  return given;
}

Case with_copies(const Case& input) {
  Case named = input;
  for (std::size_t k = 0; k < named.drop_count(); ++k) {
    Case::Drop& drop = k == 0 ? named.drop : named.more_drops[k - 1];
    if (drop.given) drop.particles_file = copy_name(k, drop.given->lines.empty());
  }
  return named;
}

void write_copies(const Communicator& communicator, const std::filesystem::path& directory, const Case& input) {
  const Case named = with_copies(input);
  std::string error;
  for (std::size_t k = 0; k < input.drop_count() && communicator.rank() == 0; ++k) {
    const Case::Drop drop = named.with_drop(k).drop;
    if (!drop.given) continue;
    const std::filesystem::path copy = directory / drop.particles_file;
    try {
      std::error_code is_not_there;
      const bool is_itself = std::filesystem::equivalent(copy, drop.given->path, is_not_there);
      if (!is_itself) write_file_atomically(copy, drop.given->content);
    } catch (const std::exception& failure) {
      error = fmt::format("cannot write {}: {}", copy.string(), failure.what());
    }
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

}  // namespace sphdrop
