#include "api/particle_columns.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace sphdrop {

namespace {

struct Found {
  const Field* field;
  std::size_t component;
  std::string name;
};

std::vector<Found> written(const ParticleSet& particles) {
  static constexpr const char* suffixes[3][3] = {{""}, {"_x", "_y"}, {"_xx", "_yy", "_xy"}};
  std::vector<Found> all;
  for (const Field* field : particles.fields()) {
    if (!has(field->roles, Role::written)) continue;
    const auto components = static_cast<std::size_t>(field->components);
    for (std::size_t c = 0; c < components; ++c)
      all.push_back({field, c, std::string(field->name) + suffixes[components - 1][c]});
  }
  return all;
}

}  // namespace

std::vector<v1::Quantity> written_columns(const ParticleSet& particles) {
  std::vector<v1::Quantity> all;
  for (const Found& f : written(particles))
    all.push_back({f.name, std::string(f.field->unit), std::string(f.field->description)});
  return all;
}

std::vector<double> owned_values(const ParticleSet& particles, const std::string& name) {
  std::string names;
  for (const Found& f : written(particles)) {
    names += (names.empty() ? "" : ", ") + f.name;
    if (f.name != name) continue;
    std::vector<double> values;
    values.reserve(particles.owned_count());
    const Column<double>& column = f.field->columns[f.component];
    particles.for_each_owned([&](std::size_t row) { values.push_back(column[row]); });
    return values;
  }
  throw v1::Error(v1::Error::Kind::mistake,
                  fmt::format("these particles have no column {}; they have {}", name, names));
}

std::vector<std::int64_t> owned_ids(const ParticleSet& particles) {
  std::vector<std::int64_t> ids;
  ids.reserve(particles.owned_count());
  particles.for_each_owned([&](std::size_t row) { ids.push_back(particles.id[row]); });
  return ids;
}

}  // namespace sphdrop
