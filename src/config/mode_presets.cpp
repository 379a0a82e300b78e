#include "config/mode_presets.hpp"

#include <algorithm>

#include "config/derived_defaults.hpp"

namespace sphdrop {
namespace {

// The liquid of low viscosity needs shifting, and shifting lets a drop swell that is torn about: over a beam's end by
// half its area within 5 ms, with a third of the impact's energy; so, too, where drops meet. There the paper's liquid
// stays.
bool has_one_drop_without_beam(const Case& values) {
  return values.drop.is_liquid() && values.more_drops.empty() && !has_beam(values);
}

// The gauge acts on the surface's curve, and shifting heeds it.
bool has_surface_alone(const Case& values) {
  return has_one_drop_without_beam(values) && values.surface_tension.form != SurfaceTensionForm::none &&
         values.surface_tension.coefficient > 0;
}

// The clamp's edge is exact for cells alone.
bool has_beam_of_cells(const Case& values) {
  return values.solid.is_elastic() && (values.solid.formulation == SolidFormulation::automatic ||
                                       values.solid.formulation == SolidFormulation::cells);
}

bool is_beam(const Case& values) {
  return values.solid.is_elastic();
}

bool has_contact(const Case& values) {
  return has_drop(values) && values.has_solid();
}

constexpr Preset presets[] = {
    {"fluid.viscosity_form", "\"physical\"", "of one drop without a beam", has_one_drop_without_beam},
    {"fluid.artificial_viscosity_alpha", "0.0", "of one drop without a beam", has_one_drop_without_beam},
    {"fluid.gauge_pressure", "\"on\"", "of one drop without a beam", has_surface_alone},
    {"fluid.shifting", "\"on\"", "of one drop without a beam", has_surface_alone},
    {"solid.formulation", "\"cells\"", "", is_beam},
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
