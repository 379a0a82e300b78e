#include "simulation/stored_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "diagnostics/state_hash.hpp"

namespace sphdrop {

namespace {

std::string column_name(const Field& field, int component) {
  static constexpr const char* suffixes[3][3] = {{"", "", ""}, {"_x", "_y", ""}, {"_xx", "_yy", "_xy"}};
  return std::string(field.name) + suffixes[field.components - 1][component];
}

template <class F>
void for_each_state_column(const ParticleSet& particles, F&& f) {
  for (Field* field : particles.fields())
    if (has(field->roles, Role::state))
      for (int c = 0; c < field->components; ++c) f(*field, c, field->columns[static_cast<std::size_t>(c)]);
}

}  // namespace

StoredParticles::StoredParticles(std::string_view name, const ParticleSet& particles, std::int64_t total)
    : name_(name), total_(total) {
  particles.for_each_owned([&](std::size_t row) { ids_.push_back(particles.id[row]); });
  for_each_state_column(particles, [&](const Field& field, int component, const Column<double>& column) {
    StoredColumn stored{column_name(field, component), std::string(field.unit), std::string(field.description), {}};
    stored.values.reserve(ids_.size());
    particles.for_each_owned([&](std::size_t row) { stored.values.push_back(column[row]); });
    columns_.push_back(std::move(stored));
  });
}

CheckpointTable StoredParticles::table() const {
  CheckpointTable table{name_, total_, ids_, {}};
  for (const StoredColumn& column : columns_)
    table.columns.push_back({column.name, column.unit, column.description, column.values});
  return table;
}

std::uint64_t StoredParticles::hash() const {
  std::uint64_t sum = 0;
  for (std::size_t row = 0; row < ids_.size(); ++row) {
    std::uint64_t hash = avalanche(static_cast<std::uint64_t>(ids_[row]));
    for (const StoredColumn& column : columns_)
      hash = avalanche(hash ^ std::bit_cast<std::uint64_t>(column.values[row])) + 0x9e3779b97f4a7c15U;
    sum += hash;
  }
  return sum;
}

void restore_particles(const Checkpoint& checkpoint, std::string_view table_name, ParticleSet& particles) {
  const Checkpoint::Table& table = checkpoint.table(table_name);
  const auto rows = static_cast<std::size_t>(table.row_count);
  particles.resize(rows);
  particles.owned.clear();
  particles.ghosts.clear();
  if (rows > 0) particles.owned = {{0, static_cast<std::int32_t>(rows)}};
  for (std::size_t row = 0; row < rows; ++row) particles.id[row] = table.first_id + static_cast<std::int64_t>(row);
  for_each_state_column(particles, [&](const Field& field, int component, Column<double>& column) {
    const std::vector<double>& values = checkpoint.column(table_name, column_name(field, component));
    std::copy(values.begin(), values.end(), column.begin());
  });
}

}  // namespace sphdrop
