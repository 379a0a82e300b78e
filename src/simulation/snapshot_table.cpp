#include "simulation/snapshot_table.hpp"

#include <algorithm>

namespace sphdrop {

namespace {

std::vector<double> owned_values(const ParticleSet& particles, const Column<double>& column) {
  std::vector<double> values;
  values.reserve(particles.owned_count());
  particles.for_each_owned([&](std::size_t row) { values.push_back(column[row]); });
  return values;
}

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

SnapshotTable::SnapshotTable(const FluidParticles& fluid, const SolidParticles& solid) {
  const std::size_t liquid_rows = fluid.owned_count(), all_rows = liquid_rows + solid.owned_count();
  fluid.for_each_owned([&](std::size_t row) { ids_.push_back(fluid.id[row]); });
  solid.for_each_owned([&](std::size_t row) { ids_.push_back(solid.id[row]); });
  material_.assign(liquid_rows, 0);
  material_.resize(all_rows, 1);
  x_ = owned_values(fluid, fluid.position.x);
  y_ = owned_values(fluid, fluid.position.y);
  append(x_, owned_values(solid, solid.position.x));
  append(y_, owned_values(solid, solid.position.y));

  const auto take = [&](const ParticleSet& particles, std::size_t first_row, const char* absent_note) {
    for (const Field* field : particles.fields()) {
      if (!has(field->roles, Role::written) || field->name == "position") continue;
      auto found = std::find_if(quantities_.begin(), quantities_.end(),
                                [&](const Quantity& quantity) { return quantity.name == field->name; });
      if (found == quantities_.end()) {
        quantities_.push_back({std::string(field->name), std::string(field->unit),
                               std::string(field->description) + absent_note,
                               std::vector<std::vector<double>>(static_cast<std::size_t>(field->components),
                                                                std::vector<double>(all_rows, 0.0))});
        found = quantities_.end() - 1;
      }
      for (std::size_t c = 0; c < found->components.size(); ++c) {
        const std::vector<double> values = owned_values(particles, field->columns[c]);
        std::copy(values.begin(), values.end(), found->components[c].begin() + static_cast<std::ptrdiff_t>(first_row));
      }
    }
  };
  take(fluid, 0, "");
  take(solid, liquid_rows, "; 0 in the liquid");
}

SnapshotRows SnapshotTable::rows(std::int64_t total) const {
  return {total, ids_, x_, y_};
}

std::vector<SnapshotColumn> SnapshotTable::columns() const {
  std::vector<SnapshotColumn> columns;
  columns.push_back(SnapshotColumn::integer("material", "0: drop, 1: solid", material_));
  for (const Quantity& q : quantities_) {
    if (q.components.size() == 1)
      columns.push_back(SnapshotColumn::scalar(q.name, q.unit, q.description, q.components[0]));
    else if (q.components.size() == 2)
      columns.push_back(SnapshotColumn::vector(q.name, q.unit, q.description, q.components[0], q.components[1]));
    else
      for (std::size_t c = 0; c < 3; ++c) {
        static constexpr const char* suffix[] = {"_xx", "_yy", "_xy"};
        columns.push_back(SnapshotColumn::scalar(q.name + suffix[c], q.unit, q.description, q.components[c]));
      }
  }
  return columns;
}

}  // namespace sphdrop
