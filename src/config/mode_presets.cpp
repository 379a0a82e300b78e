#include "config/mode_presets.hpp"

#include "config/derived_defaults.hpp"

namespace sphdrop {
namespace {

// On a beam shifting would add energy, and the paper's liquid is as near to the exact beam.
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
  return values.solid.is_elastic() && (values.solid.formulation == SolidFormulation::automatic ||
                                       values.solid.formulation == SolidFormulation::cells);
}

bool is_beam(const Case& values) {
  return values.solid.is_elastic();
}

bool has_liquid(const Case& values) {
  return values.drop.is_liquid();
}

bool has_contact(const Case& values) {
  return has_drop(values) && values.has_solid();
}

constexpr Preset presets[] = {
    {Mode::modern, "fluid.viscosity_form", "\"physical\"", "without a beam", has_liquid_without_beam},
    {Mode::modern, "fluid.artificial_viscosity_alpha", "0.0", "without a beam", has_liquid_without_beam},
    {Mode::modern, "fluid.gauge_pressure", "\"on\"", "without a beam", has_surface_alone},
    {Mode::modern, "fluid.shifting", "\"on\"", "without a beam", has_surface_alone},
    {Mode::modern, "solid.formulation", "\"cells\"", "", is_beam},
    {Mode::modern, "solid.clamp", "\"ideal\"", "", has_beam_of_cells},
    {Mode::modern, "contact.stiffness_form", "\"fixed\"", "", has_contact},
    {Mode::fast, "time.solid_substeps", "0", "", has_beam},
    // What counts is the time between corrections, and steps are long.
    {Mode::fast, "fluid.density_correction_interval", "10", "", has_liquid},
    {Mode::fast, "surface_tension.detection_displacement", "0.06", "", has_liquid},
    {Mode::fast, "surface_tension.detection_motion", "\"relative\"", "", has_liquid},
};

}  // namespace

std::span<const Preset> mode_presets() {
  return presets;
}

}  // namespace sphdrop
