#include "simulation/cell_step.hpp"

#include <algorithm>
#include <cassert>

namespace sphdrop {

namespace {

AnyCellMaterial cell_material(const Case::Solid& solid, double spacing) {
  const ElasticMaterial material{solid.density, solid.youngs_modulus, solid.poisson_ratio};
  const LameModuli moduli(material);
  const double nu = material.poisson_ratio;
  const double bending_modulus = material.youngs_modulus / (1.0 - nu * nu);
  if (solid.material_law == MaterialLaw::neo_hookean)
    return CellMaterial<NeoHookean>{{moduli}, bending_modulus, spacing, solid.viscous_time};
  return CellMaterial<StVenantKirchhoff>{{moduli}, bending_modulus, spacing, solid.viscous_time};
}

LatticeTurn turn_of(const Case::Solid& solid) {
  if (solid.kind != SolidKind::polygon) return {};
  const Vector rows = unit({solid.lattice_x, solid.lattice_y});
  return {rows.x, rows.y};
}

LatticeCells cells_of(const Case::Solid& solid, const InitialSolid& initial, IdRange particles, double spacing) {
  const bool held_at_edge = solid.clamp == Clamp::ideal;
  if (!initial.columns.empty()) return LatticeCells(initial.columns, held_at_edge);
  // What has no columns is no share.
  assert(initial.indices().contains(particles) && initial.before == 0);
  const auto first = static_cast<std::size_t>(particles.first), count = static_cast<std::size_t>(particles.count());
  std::span<const std::array<PlaneMoments, 4>> quadrants;
  if (solid.kind == SolidKind::polygon) quadrants = std::span(initial.quadrants).subspan(first, count);
  // The lattice's own places.
  std::vector<Vector> places(initial.positions.begin() + static_cast<std::ptrdiff_t>(first),
                             initial.positions.begin() + static_cast<std::ptrdiff_t>(first + count));
  const LatticeTurn turn = turn_of(solid);
  if (!turn.is_none())
    for (Vector& p : places) p = {turn.cosine * p.x + turn.sine * p.y, turn.cosine * p.y - turn.sine * p.x};
  return LatticeCells(places, std::span(initial.is_fixed).subspan(first, count), spacing, held_at_edge, quadrants);
}

}  // namespace

CellStep::CellStep(const Case& input, const InitialSolid& initial, std::int64_t first_id)
    : spacing_(input.resolution.spacing),
      is_viscous_(input.any_solid([](const Case::Solid& one) { return one.is_elastic() && one.viscous_time > 0; })),
      is_damped_(is_viscous_ || input.any_solid([](const Case::Solid& one) {
        return one.is_elastic() && (one.damping_rate > 0 || one.damping_ratio > 0);
      })) {
  for (const SolidIds& ids : solid_bodies(initial, first_id)) {
    const Case::Solid& solid = input.solid_at(ids.solid);
    if (!solid.is_elastic()) {
      rigid_.push_back(ids);
      continue;
    }
    bodies_.push_back({cells_of(solid, initial, {ids.begin - first_id, ids.end - first_id}, spacing_),
                       CellSweep(cell_material(solid, spacing_), turn_of(solid)), solid.density, ids.begin});
  }
}

std::vector<Column<double>*> CellStep::ghosted(SolidParticles& solid) const {
  std::vector<Column<double>*> columns{&solid.position.x, &solid.position.y};
  if (is_viscous_) columns.insert(columns.end(), {&solid.velocity.x, &solid.velocity.y});
  return columns;
}

void CellStep::relist(SolidParticles& solid, const Distribution&) {
  for (Body& body : bodies_) body.sweep.set_mesh(CellMesh(solid, body.lattice, body.first_id));
}

void CellStep::predict(SolidParticles& solid, double previous_step) {
  predict_velocity(solid, previous_step);
}

void CellStep::sweep_inner(SolidParticles& solid, const Distribution&) {
  for (Body& body : bodies_) body.sweep.sweep(solid, CellSweep::Cells::without_ghosts);
}

void CellStep::sweep_rest(SolidParticles& solid, const Distribution&) {
  for (Body& body : bodies_) body.sweep.sweep(solid, CellSweep::Cells::with_ghosts);
  // Other damping adds to the heating, which starts from nothing, and so does the contact's force on what is rigid.
  if (is_damped_ && (!is_viscous_ || bodies_.size() > 1 || !rigid_.empty()))
    for (const RowRange& range : solid.owned)
      std::fill(solid.dissipation_rate.data() + range.begin, solid.dissipation_rate.data() + range.end, 0.0);
  for (const SolidIds& ids : rigid_)
    for_each_owned_of(solid, ids, [&](std::size_t row) { solid.acceleration.set(row, {}); });
  for (Body& body : bodies_) body.sweep.accelerate(solid);
}

MotionMaxima CellStep::move(SolidParticles& solid, StepLengths steps, double speed_limit) {
  return kick_and_drift_velocity(solid, steps, speed_limit, is_damped_);
}

void CellStep::complete(SolidParticles& solid) const {
  for (const Body& body : bodies_) body.sweep.complete(solid, body.density);
  // What is rigid is not deformed.
  for (const SolidIds& ids : rigid_)
    for_each_owned_of(solid, ids, [&](std::size_t row) {
      for (Column<double>& column : solid.stress.columns) column[row] = 0.0;
      solid.pressure[row] = 0.0;
      solid.density[row] = solid.staggered_density[row];
    });
}

void CellStep::add_elastic_energy(const SolidParticles& solid, ExactSum& sum) const {
  // A cell belongs to the owner of its south-west corner.
  for (const Body& body : bodies_)
    solid.for_each_owned([&](std::size_t row) {
      if (body.sweep.mesh().is_cell(static_cast<std::int32_t>(row)))
        sum.add(body.sweep.energy(solid, static_cast<std::int32_t>(row)));
    });
}

std::optional<SolidStep::Inversion> CellStep::inversion(const SolidParticles& solid) const {
  for (const Body& body : bodies_)
    if (const auto& found = body.sweep.inverted())
      return Inversion{solid.id[static_cast<std::size_t>(found->row)], found->determinant};
  return std::nullopt;
}

}  // namespace sphdrop
