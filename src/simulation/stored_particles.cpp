#include "simulation/stored_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "diagnostics/state_hash.hpp"
#include "simulation/owned_pieces.hpp"

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
      for (int c = 0; c < field->components; ++c) f(*field, c);
}

}  // namespace

StoredParticles::StoredParticles(std::string_view name, const ParticleSet& particles, std::int64_t total)
    : name_(name), particles_(particles), total_(total) {}

CheckpointTable StoredParticles::table() const {
  CheckpointTable table{name_, total_, {}, {}};
  add_owned(table.ids, particles_, particles_.id);
  for_each_state_column(particles_, [&](const Field& field, int component) {
    table.columns.push_back(
        {column_name(field, component), std::string(field.unit), std::string(field.description), {}});
    add_owned(table.columns.back().values, particles_, field, component);
  });
  return table;
}

std::uint64_t StoredParticles::hash() const {
  std::vector<const double*> columns;  // nullptr: left out
  for_each_state_column(particles_, [&](const Field& field, int component) {
    columns.push_back(field.is_left_out() ? nullptr : field.columns[static_cast<std::size_t>(component)].data());
  });
  std::uint64_t sum = 0;
  particles_.for_each_owned([&](std::size_t row) {
    std::uint64_t hash = avalanche(static_cast<std::uint64_t>(particles_.id[row]));
    for (const double* column : columns)
      hash =
          avalanche(hash ^ std::bit_cast<std::uint64_t>(column == nullptr ? 0.0 : column[row])) + 0x9e3779b97f4a7c15U;
    sum += hash;
  });
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
  for_each_state_column(particles, [&](Field& field, int component) {
    const std::vector<double>& values = checkpoint.column(table_name, column_name(field, component));
    if (!field.is_left_out())
      std::copy(values.begin(), values.end(), field.columns[static_cast<std::size_t>(component)].begin());
  });
}

}  // namespace sphdrop
