#include "simulation/solid_step.hpp"

#include <stdexcept>

#include "setup/setup_error.hpp"
#include "simulation/cell_step.hpp"
#include "simulation/hypoelastic_step.hpp"
#include "simulation/total_lagrangian_step.hpp"

namespace sphdrop {

std::unique_ptr<SolidStep> make_solid_step(const Case& input, const HypoelasticParameters& parameters,
                                           const InitialSolid& initial, std::int64_t first_id) {
  // A wall has no stress to compute, whatever the formulation.
  const bool is_beam = input.solid.kind == SolidKind::cantilever || input.solid.kind == SolidKind::fixed_fixed_beam;
  if (!is_beam || input.solid.formulation == SolidFormulation::hypoelastic)
    return std::make_unique<HypoelasticStep>(input, parameters);
  if (input.solid.formulation == SolidFormulation::total_lagrangian)
    return std::make_unique<TotalLagrangianStep>(input, parameters.material, parameters.pair.kernel);
  try {
    return std::make_unique<CellStep>(input, parameters.material, initial, first_id);
  } catch (const std::invalid_argument& error) {
    throw SetupError(error.what());
  }
}

}  // namespace sphdrop
