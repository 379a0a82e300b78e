#include "simulation/solid_step.hpp"

#include <stdexcept>

#include "setup/setup_error.hpp"
#include "simulation/cell_step.hpp"
#include "simulation/hypoelastic_step.hpp"
#include "simulation/total_lagrangian_step.hpp"

namespace sphdrop {

std::unique_ptr<SolidStep> make_solid_step(const Case& input, const HypoelasticParameters& parameters,
                                           const InitialSolid& initial, std::int64_t first_id) {
  const auto has_elastic = [&](SolidFormulation formulation) {
    return input.any_solid([&](const Case::Solid& one) { return one.is_elastic() && one.formulation == formulation; });
  };
  if (has_elastic(SolidFormulation::total_lagrangian))
    return std::make_unique<TotalLagrangianStep>(input, parameters.material, parameters.pair.kernel, initial, first_id);
  // A wall has no stress to compute, whatever the formulation.
  if (!has_elastic(SolidFormulation::cells)) return std::make_unique<HypoelasticStep>(input, parameters);
  try {
    return std::make_unique<CellStep>(input, initial, first_id);
  } catch (const std::invalid_argument& error) {
    throw SetupError(error.what());
  }
}

}  // namespace sphdrop
