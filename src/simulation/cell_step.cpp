#include "simulation/cell_step.hpp"

#include <algorithm>

namespace sphdrop {

namespace {

AnyCellMaterial cell_material(const Case& input, const ElasticMaterial& material) {
  const LameModuli moduli(material);
  const double nu = material.poisson_ratio;
  const double bending_modulus = material.youngs_modulus / (1.0 - nu * nu);
  const double spacing = input.resolution.spacing, viscous_time = input.solid.viscous_time;
  if (input.solid.material_law == MaterialLaw::neo_hookean)
    return CellMaterial<NeoHookean>{{moduli}, bending_modulus, spacing, viscous_time};
  return CellMaterial<StVenantKirchhoff>{{moduli}, bending_modulus, spacing, viscous_time};
}

}  // namespace

CellStep::CellStep(const Case& input, const ElasticMaterial& material, const InitialSolid& initial,
                   std::int64_t first_id)
    : lattice_(initial.positions, initial.is_fixed, input.resolution.spacing, input.solid.clamp == Clamp::ideal),
      sweep_(cell_material(input, material)),
      spacing_(input.resolution.spacing),
      density_(material.density),
      first_id_(first_id),
      is_viscous_(input.solid.viscous_time > 0),
      is_damped_(is_viscous_ || input.solid.damping_rate > 0 || input.solid.damping_ratio > 0) {}

std::vector<Column<double>*> CellStep::ghosted(SolidParticles& solid) const {
  std::vector<Column<double>*> columns{&solid.position.x, &solid.position.y};
  if (is_viscous_) columns.insert(columns.end(), {&solid.velocity.x, &solid.velocity.y});
  return columns;
}

void CellStep::relist(SolidParticles& solid, const Distribution&) {
  sweep_.set_mesh(CellMesh(solid, lattice_, first_id_));
}

void CellStep::predict(SolidParticles& solid, double previous_step) {
  predict_velocity(solid, previous_step);
}

void CellStep::sweep_inner(SolidParticles& solid, const Distribution&) {
  sweep_.sweep(solid, CellSweep::Cells::without_ghosts);
}

void CellStep::sweep_rest(SolidParticles& solid, const Distribution&) {
  sweep_.sweep(solid, CellSweep::Cells::with_ghosts);
  // Other damping adds to the heating, which starts from nothing.
  if (is_damped_ && !is_viscous_)
    for (const RowRange& range : solid.owned)
      std::fill(solid.dissipation_rate.data() + range.begin, solid.dissipation_rate.data() + range.end, 0.0);
  sweep_.accelerate(solid);
}

MotionMaxima CellStep::move(SolidParticles& solid, StepLengths steps, double speed_limit) {
  return kick_and_drift_velocity(solid, steps, speed_limit, is_damped_);
}

void CellStep::complete(SolidParticles& solid) const {
  sweep_.complete(solid, density_);
}

void CellStep::add_elastic_energy(const SolidParticles& solid, ExactSum& sum) const {
  // A cell belongs to the owner of its south-west corner.
  solid.for_each_owned([&](std::size_t row) {
    if (sweep_.mesh().is_cell(static_cast<std::int32_t>(row)))
      sum.add(sweep_.energy(solid, static_cast<std::int32_t>(row)));
  });
}

std::optional<SolidStep::Inversion> CellStep::inversion(const SolidParticles& solid) const {
  const auto& found = sweep_.inverted();
  if (!found) return std::nullopt;
  return Inversion{solid.id[static_cast<std::size_t>(found->row)], found->determinant};
}

}  // namespace sphdrop
