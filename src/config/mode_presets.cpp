#include "config/mode_presets.hpp"

#include <algorithm>

#include "config/derived_defaults.hpp"

namespace sphdrop {
namespace {

// On a beam the paper's liquid loses less of the energy to what is not accounted for, and is as near to the exact beam.
bool has_liquid_without_beam(const Case& values) {
  return values.drop.is_liquid() && !has_beam(values);
}

// The gauge acts on the surface's curve, and shifting heeds it.
bool has_surface_alone(const Case& values) {
  return has_liquid_without_beam(values) && values.surface_tension.form != SurfaceTensionForm::none &&
         values.surface_tension.coefficient > 0;
}

// The clamp's edge is exact for cells alone.
bool has_beam_of_cells(const Case& values) {
  return has_beam(values) && (values.solid.formulation == SolidFormulation::automatic ||
                              values.solid.formulation == SolidFormulation::cells);
}

bool has_contact(const Case& values) {
  return has_drop(values) && values.solid.kind != SolidKind::none;
}

constexpr Preset presets[] = {
    {"fluid.viscosity_form", "\"physical\"", "without a beam", has_liquid_without_beam},
    {"fluid.artificial_viscosity_alpha", "0.0", "without a beam", has_liquid_without_beam},
    {"fluid.gauge_pressure", "\"on\"", "without a beam", has_surface_alone},
    {"fluid.shifting", "\"on\"", "without a beam", has_surface_alone},
    {"solid.formulation", "\"cells\"", "", has_beam},
    {"solid.clamp", "\"ideal\"", "", has_beam_of_cells},
    {"contact.stiffness_form", "\"fixed\"", "", has_contact},
};

}  // namespace

std::span<const Preset> modern_presets() {
  return presets;
}

const Preset* modern_preset(std::string_view key) {
  const auto found =
      std::find_if(std::begin(presets), std::end(presets), [&](const Preset& p) { return p.key == key; });
  return found == std::end(presets) ? nullptr : &*found;
}

}  // namespace sphdrop
