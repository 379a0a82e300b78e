#include "simulation/snapshot_table.hpp"

#include <string_view>

#include "simulation/owned_pieces.hpp"

namespace sphdrop {

namespace {

/// Of a quantity that may be of one material only.
const Field* written_field(const ParticleSet& particles, std::string_view name) {
  for (const Field* field : particles.fields())
    if (has(field->roles, Role::written) && field->name == name) return field;
  return nullptr;
}

}  // namespace

SnapshotTable::SnapshotTable(const FluidParticles& fluid, const SolidParticles& solid) {
  const std::size_t liquid_rows = fluid.owned_count(), solid_rows = solid.owned_count();
  add_owned(ids_, fluid, fluid.id);
  add_owned(ids_, solid, solid.id);
  material_.add_constant(0, liquid_rows);
  material_.add_constant(1, solid_rows);
  add_owned(x_, fluid, fluid.position.x);
  add_owned(x_, solid, solid.position.x);
  add_owned(y_, fluid, fluid.position.y);
  add_owned(y_, solid, solid.position.y);

  const auto take = [&](const Field& described, const Field* of_liquid, const Field* of_solid) {
    Quantity& quantity = quantities_.emplace_back();
    quantity.name = described.name;
    quantity.unit = described.unit;
    quantity.description = std::string(described.description) + (of_liquid == nullptr ? "; 0 in the liquid" : "");
    for (int c = 0; c < described.components; ++c) {
      Pieces<double>& component = quantity.components.emplace_back();
      const auto add_part = [&](const ParticleSet& particles, const Field* field, std::size_t rows) {
        if (field == nullptr)
          component.add_constant(0.0, rows);
        else
          add_owned(component, particles, *field, c);
      };
      add_part(fluid, of_liquid, liquid_rows);
      add_part(solid, of_solid, solid_rows);
    }
  };
  const auto is_taken = [](const Field& field) { return has(field.roles, Role::written) && field.name != "position"; };
  for (const Field* field : fluid.fields())
    if (is_taken(*field)) take(*field, field, written_field(solid, field->name));
  for (const Field* field : solid.fields())
    if (is_taken(*field) && written_field(fluid, field->name) == nullptr) take(*field, nullptr, field);
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
