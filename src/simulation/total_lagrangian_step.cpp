#include "simulation/total_lagrangian_step.hpp"

#include <algorithm>

namespace sphdrop {

namespace {

AnyTotalLagrangianMaterial material_of(const Case& input, const ElasticMaterial& material) {
  const LameModuli moduli(material);
  const Case::Solid& solid = input.first_elastic_solid();
  if (solid.material_law == MaterialLaw::neo_hookean)
    return TotalLagrangianMaterial<NeoHookean>{{moduli}, material.density, solid.viscous_time};
  return TotalLagrangianMaterial<StVenantKirchhoff>{{moduli}, material.density, solid.viscous_time};
}

}  // namespace

TotalLagrangianStep::TotalLagrangianStep(const Case& input, const ElasticMaterial& material, const CubicSpline& kernel,
                                         const InitialSolid& initial, std::int64_t first_id)
    : sweep_(material_of(input, material), kernel),
      is_viscous_(input.any_solid([](const Case::Solid& one) { return one.is_elastic() && one.viscous_time > 0; })),
      is_damped_(is_viscous_ || input.any_solid([](const Case::Solid& one) {
        return one.is_elastic() && (one.damping_rate > 0 || one.damping_ratio > 0);
      })) {
  for (const SolidIds& ids : solid_bodies(initial, first_id))
    if (!input.solid_at(ids.solid).is_elastic()) rigid_.push_back(ids);
}

std::vector<Column<double>*> TotalLagrangianStep::ghosted(SolidParticles& solid) const {
  std::vector<Column<double>*> columns{&solid.position.x, &solid.position.y};
  if (is_viscous_) columns.insert(columns.end(), {&solid.velocity.x, &solid.velocity.y});
  return columns;
}

void TotalLagrangianStep::relist(SolidParticles& solid, const Distribution&) {
  // The particles of a line have no gradient across it.
  std::vector<char> is_rigid(solid.size(), 0);
  for (std::size_t row = 0; row < solid.size(); ++row)
    for (const SolidIds& ids : rigid_)
      if (solid.id[row] >= ids.begin && solid.id[row] < ids.end) is_rigid[row] = 1;
  sweep_.relist(solid, is_rigid);
}

void TotalLagrangianStep::predict(SolidParticles& solid, double previous_step) {
  predict_velocity(solid, previous_step);
}

void TotalLagrangianStep::sweep_inner(SolidParticles& solid, const Distribution&) {
  sweep_.deform(solid, TotalLagrangianSweep::Blocks::without_ghosts);
}

void TotalLagrangianStep::sweep_rest(SolidParticles& solid, const Distribution&) {
  sweep_.deform(solid, TotalLagrangianSweep::Blocks::with_ghosts);
  // Other damping adds to the heating, which starts from nothing.
  if (is_damped_ && !is_viscous_)
    for (const RowRange& range : solid.owned)
      std::fill(solid.dissipation_rate.data() + range.begin, solid.dissipation_rate.data() + range.end, 0.0);
  sweep_.accelerate(solid);
}

MotionMaxima TotalLagrangianStep::move(SolidParticles& solid, StepLengths steps, double speed_limit) {
  return kick_and_drift_velocity(solid, steps, speed_limit, is_damped_);
}

void TotalLagrangianStep::complete(SolidParticles& solid) const {
  sweep_.complete(solid);
}

void TotalLagrangianStep::add_elastic_energy(const SolidParticles& solid, ExactSum& sum) const {
  solid.for_each_owned([&](std::size_t row) { sum.add(sweep_.energy(solid, static_cast<std::int32_t>(row))); });
}

std::optional<SolidStep::Inversion> TotalLagrangianStep::inversion(const SolidParticles& solid) const {
  const auto found = sweep_.inverted(solid);
  if (!found) return std::nullopt;
  return Inversion{solid.id[static_cast<std::size_t>(found->row)], found->determinant};
}

}  // namespace sphdrop
