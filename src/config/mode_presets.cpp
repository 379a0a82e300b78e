#include "config/mode_presets.hpp"

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

bool has_liquid(const Case& values) {
  return values.drop.is_liquid();
}

bool has_contact(const Case& values) {
  return has_drop(values) && values.has_solid();
}

constexpr Preset presets[] = {
    {Mode::modern, "fluid.viscosity_form", "\"physical\"", "of one drop without a beam", has_one_drop_without_beam},
    {Mode::modern, "fluid.artificial_viscosity_alpha", "0.0", "of one drop without a beam", has_one_drop_without_beam},
    {Mode::modern, "fluid.gauge_pressure", "\"on\"", "of one drop without a beam", has_surface_alone},
    {Mode::modern, "fluid.shifting", "\"on\"", "of one drop without a beam", has_surface_alone},
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
