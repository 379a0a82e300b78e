#include "config/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/check.hpp"
#include "config/derived_defaults.hpp"
#include "config/drop_checks.hpp"
#include "config/key_suggestion.hpp"
#include "config/polygon.hpp"
#include "config/several_drops.hpp"
#include "config/solid_checks.hpp"
#include "config/utf8.hpp"

namespace sphdrop {
namespace {

constexpr double most_particles = 2e9;
constexpr double whole_number_tolerance = 1e-6;

bool is_whole(double ratio) {
  const double nearest = std::round(ratio);
  return std::abs(ratio - nearest) <= whole_number_tolerance * std::max(1.0, nearest);
}

double columns_along(const Case& values) {
  return values.solid.length / values.resolution.spacing;
}

double drop_area(const Case::Drop& drop) {
  if (drop.shape == DropShape::none) return 0;
  const double square = drop.diameter * drop.diameter;
  return drop.shape == DropShape::square ? square : square * std::numbers::pi / 4;
}

Verdict nothing_to_simulate(const Case& values) {
  if (has_drop(values) || has_beam(values)) return {};
  return "nothing moves in this case: give a drop (drop.shape = \"round\" or \"square\") or a beam (solid.kind = "
         "\"cantilever\" or \"fixed_fixed_beam\")";
}

Verdict several_drops_not_liquid(const Case& values) {
  if (values.more_drops.empty()) return {};
  for (std::size_t k = 0; k < values.drop_count(); ++k) {
    const Case::Drop drop = values.with_drop(k).drop;
    if (!drop.is_liquid())
      return fmt::format("several drops must all be liquid, and drop {} is {}; a rigid one must be the only one", k + 1,
                         drop.is_rigid() ? "rigid" : "none");
    if (drop.relaxation_time > 0)
      return fmt::format("drop.relaxation_time of drop {} must be 0 where there are several drops", k + 1);
  }
  return {};
}

Verdict height_of_a_drop_above_the_solid(const Case& values) {
  if (values.drop.centre_y == 0 || !values.has_solid() || values.drop.placement != DropPlacement::above_solid)
    return {};
  return "drop.centre_y needs drop.placement = \"centre\" where there is a solid: otherwise drop.gap says how high "
         "above "
         "it the drop is";
}

Verdict oscillation_of_another_shape(const Case& values) {
  if (values.drop.oscillation_velocity == 0 || values.drop.shape == DropShape::round) return {};
  return "drop.oscillation_velocity needs drop.shape = \"round\": the oscillating field is that of a round drop; set "
         "it to "
         "0 or make the drop round";
}

Verdict velocity_without_drop(const Case& values) {
  if (has_drop(values) || (values.drop.velocity_x == 0 && values.drop.velocity_y == 0)) return {};
  return "drop.velocity is given but there is no drop; set it to [0, 0] or give drop.shape";
}

Verdict rigid_without_drop(const Case& values) {
  if (has_drop(values) || values.drop.material == DropMaterial::liquid) return {};
  return "drop.material = \"rigid\" but there is no drop; leave it out or give drop.shape";
}

Verdict oscillation_of_a_rigid_drop(const Case& values) {
  if (values.drop.oscillation_velocity == 0 || !values.drop.is_rigid()) return {};
  return "drop.oscillation_velocity needs drop.material = \"liquid\": a rigid drop cannot change its shape; set it to "
         "0 "
         "or make the drop liquid";
}

Verdict spin_of_a_liquid(const Case& values) {
  if (values.drop.initial_spin == 0 || values.drop.is_rigid()) return {};
  return "drop.initial_spin needs drop.material = \"rigid\": only a rigid drop starts with a spin; set it to 0 or make "
         "the drop rigid";
}

Verdict density_of_a_liquid(const Case& values) {
  if (!values.drop.is_liquid() || values.drop.density == values.fluid.density) return {};
  return fmt::format(
      "drop.density = {} kg/m3 is that of a rigid drop, and this one is liquid with fluid.density = {} kg/m3; leave it "
      "out, or make the drop rigid (drop.material = \"rigid\")",
      values.drop.density, values.fluid.density);
}

Verdict no_surface_for(const Case& values, Switch ingredient, const char* key) {
  const bool has_surface =
      values.surface_tension.form != SurfaceTensionForm::none && values.surface_tension.coefficient > 0;
  if (!values.drop.is_liquid() || ingredient == Switch::off || has_surface) return {};
  return fmt::format(
      "{} = \"on\" needs the liquid's surface, which surface tension finds: set it to \"off\", or give "
      "surface_tension.form and a coefficient > 0",
      key);
}

Verdict gauge_without_surface(const Case& values) {
  return no_surface_for(values, values.fluid.gauge_pressure, "fluid.gauge_pressure");
}

Verdict ambient_pressure_without_gauge(const Case& values) {
  if (values.fluid.ambient_pressure == 0 || values.fluid.gauge_pressure == Switch::on) return {};
  return "fluid.ambient_pressure needs fluid.gauge_pressure = \"on\", which brings it to the liquid's surface: set it "
         "to 0, or switch the gauge on";
}

Verdict shifting_without_surface(const Case& values) {
  return no_surface_for(values, values.fluid.shifting, "fluid.shifting");
}

Verdict relaxation_of_another_drop(const Case& values) {
  if (values.drop.relaxation_time == 0 || values.drop.is_liquid()) return {};
  return "drop.relaxation_time needs a liquid drop: leave it out, or give drop.shape and drop.material = \"liquid\"";
}

Verdict relaxation_beside_a_swinging_beam(const Case& values) {
  if (values.drop.relaxation_time == 0 || values.solid.initial_tip_velocity == 0) return {};
  return "solid.initial_tip_velocity and drop.relaxation_time exclude each other: the beam would swing while the drop "
         "comes to rest; set one of them to 0";
}

Verdict drop_too_small(const Case& values) {
  const double d = values.resolution.spacing;
  if (!has_drop(values) || values.drop.diameter >= 4 * d * (1 - whole_number_tolerance)) return {};
  return fmt::format("drop.diameter = {} m is less than 4 spacings of {} m; take resolution.spacing <= {} m",
                     values.drop.diameter, d, values.drop.diameter / 4);
}

Verdict beam_without_length(const Case& values) {
  if (!values.solid.is_straight_beam() || !std::isnan(values.solid.length)) return {};
  return "solid.length is missing: a beam needs its free length, in m";
}

Verdict rows_not_whole(const Case& values) {
  if (!values.solid.is_straight_beam()) return {};
  const double rows = rows_across(values);
  const double H = values.solid.thickness;
  if (rows < 2 - whole_number_tolerance) {
    return fmt::format(
        "solid.thickness = {} m holds {:.3g} row{} of spacing {} m; a beam needs at least 2, better 10: take "
        "resolution.spacing = {} m",
        H, rows, rows == 1 ? "" : "s", values.resolution.spacing, H / 10);
  }
  if (is_whole(rows)) return {};
  return fmt::format(
      "solid.thickness = {} m is {:.8g} rows of spacing {} m, not a whole number; the nearest values "
      "of resolution.spacing that fit are {:.10g} m ({} rows) and {:.10g} m ({} rows)",
      H, rows, values.resolution.spacing, H / std::floor(rows), std::floor(rows), H / std::ceil(rows), std::ceil(rows));
}

Verdict length_not_whole(const Case& values) {
  if (!values.solid.is_straight_beam() || std::isnan(values.solid.length)) return {};
  const double columns = columns_along(values);
  const double d = values.resolution.spacing;
  if (columns < 4 * (1 - whole_number_tolerance)) {
    return fmt::format("solid.length = {} m holds {:.3g} columns of spacing {} m; a beam needs at least 4",
                       values.solid.length, columns, d);
  }
  if (is_whole(columns)) return {};
  return fmt::format(
      "solid.length = {} m is {:.10g} spacings of {} m, not a whole number; the nearest lengths that fit are "
      "{:.10g} m and {:.10g} m",
      values.solid.length, columns, d, std::floor(columns) * d, std::ceil(columns) * d);
}

// A strip thinner than the kernel's support would let the beam's particles see past it.
Verdict clamp_thinner_than_support(const Case& values) {
  if (!values.solid.is_straight_beam() || values.solid.clamp == Clamp::ideal) return {};
  const double support = 2 * values.resolution.smoothing_ratio;  // in spacings
  if (static_cast<double>(values.solid.clamp_layers) < support * (1 - whole_number_tolerance)) {
    return fmt::format("solid.clamp_layers = {} is thinner than the kernel's support of {} spacings; take at least {}",
                       values.solid.clamp_layers, support, std::ceil(support));
  }
  return {};
}

Verdict clamp_shorter_than_support(const Case& values) {
  if (!values.solid.is_straight_beam() || rows_across(values) < 2 - whole_number_tolerance)
    return {};  // refused as too thin
  const double support = 2 * values.resolution.smoothing_ratio * values.resolution.spacing;
  if (values.solid.clamp_length < support * (1 - whole_number_tolerance)) {
    return fmt::format("solid.clamp_length = {} m is shorter than the kernel's support of {} m; take at least that",
                       values.solid.clamp_length, support);
  }
  return {};
}

Verdict tip_velocity_of_another_solid(const Case& values) {
  if (values.solid.initial_tip_velocity == 0 || values.solid.kind == SolidKind::cantilever) return {};
  return "solid.initial_tip_velocity needs solid.kind = \"cantilever\": the initial velocity is that of its first "
         "mode; set "
         "it to 0 or make the solid a cantilever";
}

Verdict damping_of_another_solid(const Case& values) {
  if ((values.solid.damping_rate == 0 && values.solid.damping_ratio == 0 && values.solid.viscous_time == 0) ||
      values.solid.is_elastic())
    return {};
  const char* key = values.solid.damping_rate > 0    ? "solid.damping_rate"
                    : values.solid.damping_ratio > 0 ? "solid.damping_ratio"
                                                     : "solid.viscous_time";
  return key + std::string(
                   " needs a beam (solid.kind = \"cantilever\" or \"fixed_fixed_beam\"): nothing else is damped by "
                   "it; set it to 0");
}

Verdict viscosity_of_another_formulation(const Case& values) {
  if (values.solid.viscous_time == 0 || values.solid.formulation != SolidFormulation::hypoelastic) return {};
  return "solid.viscous_time needs solid.formulation = \"cells\" or \"total_lagrangian\": the hypoelastic solid "
         "has solid.artificial_viscosity_alpha instead; set it to 0 or take one of them";
}

// Far beyond any use: a velocity would change its sign from step to step.
Verdict damping_within_a_step(const Case& values) {
  const StepBound bound = largest_step(values);
  if (!values.solid.is_elastic() || values.solid.damping_rate * bound.step <= 1) return {};
  return fmt::format(
      "solid.damping_rate = {} 1/s would stop the beam within one time step of {:.4g} s, the bound of {} at a CFL "
      "factor of 1; take at most {:.4g} 1/s; 2 omega is enough to bring a mode of angular frequency omega to rest",
      values.solid.damping_rate, bound.step, bound.equation, 1 / bound.step);
}

Verdict step_too_large(const Case& values) {
  if (!(values.time.step > 0)) return {};
  const StepBound bound = largest_step(values);
  if (values.time.step <= bound.step) return {};
  return fmt::format(
      "time.step = {} s exceeds {:.4g} s, the bound of {} at a CFL factor of 1; take at most a tenth of that, "
      "or \"auto\"",
      values.time.step, bound.step, bound.equation);
}

Verdict substeps_of_another_solid(const Case& values) {
  if (values.time.solid_substeps <= 1 || can_take_substeps(values)) return {};
  return fmt::format(
      "time.solid_substeps = {} needs a beam of solid.formulation = \"cells\" or \"total_lagrangian\" and a liquid "
      "drop; "
      "set it to 1",
      values.time.solid_substeps);
}

Verdict contact_angle_without_surface(const Case& values) {
  if (!values.is_wetting()) return {};
  const char* lacks = !values.drop.is_liquid()                                  ? "there is no liquid drop"
                      : !values.has_solid()                                     ? "there is no solid to wet"
                      : values.surface_tension.form == SurfaceTensionForm::none ? "there is no surface tension"
                      : values.surface_tension.coefficient == 0                 ? "the surface tension is zero"
                                                                                : nullptr;
  if (lacks == nullptr) return {};
  return fmt::format("surface_tension.contact_angle = {} degrees, but {}; leave it out",
                     values.surface_tension.contact_angle, lacks);
}

// A particle pushed out at this rate would be thrown beyond the boundary's reach within a step.
Verdict contact_stiffer_than_a_step(const Case& values) {
  if (values.contact.stiffness_form != ContactStiffness::time_step || values.contact.stiffness <= 1) return {};
  return fmt::format(
      "contact.stiffness = {} moves a particle by more than its overlap within a step; take at most 1, or "
      "contact.stiffness_form = \"fixed\"",
      values.contact.stiffness);
}

// Twice this is where the leap-frog would be unstable.
Verdict contact_springs_within_a_step(const Case& values) {
  if (values.contact.stiffness_form != ContactStiffness::fixed || !has_drop(values) || !values.has_solid()) return {};
  const double d = values.resolution.spacing;
  double inverse_mass = 1 / (values.drop.density * d * d);
  // What is lightest at the surface: there a polygon's particles have half a square at least, and share by
  // extrapolation.
  inverse_mass += largest_over_solids(values, [&](const Case& one) {
    if (!one.solid.is_elastic()) return 0.0;
    return (one.solid.kind == SolidKind::polygon ? 4 : 1) / (one.solid.density * d * d);
  });
  const double rate = values.contact_modulus() * inverse_mass;
  const double step = values.time.step > 0 ? values.time.step : sound_step(values);
  if (values.contact.stiffness * rate * step * step <= 1) return {};
  return fmt::format(
      "contact.stiffness = {} makes springs too stiff for a time step of {:.4g} s; take at most {:.4g}, or a smaller "
      "time.sound_cfl or time.step",
      values.contact.stiffness, step, 1 / (rate * step * step));
}

Verdict step_beyond_end(const Case& values) {
  if (values.time.step <= values.time.end) return {};
  return fmt::format("time.step = {} s is longer than the run, time.end = {} s", values.time.step, values.time.end);
}

Verdict too_many_particles(const Case& values) {
  const double count = particle_count(values);
  if (!(count > most_particles)) return {};
  return fmt::format(
      "the case has about {:.2g} particles; the most is {:.0e}: check the units (m) of the lengths, or take a "
      "larger resolution.spacing",
      count, most_particles);
}

Verdict name_not_a_file_name(const Case& values) {
  const bool is_one = values.name != "." && values.name != ".." && values.name.find('/') == std::string::npos &&
                      values.name.size() <= 200 && std::none_of(values.name.begin(), values.name.end(), is_control) &&
                      !first_invalid_utf8(values.name);
  if (is_one && values.name != "auto" && !values.name.empty()) return {};
  return fmt::format(
      "name = \"{}\" must do as the name of a file: at most 200 bytes of text, without \"/\", and not "
      "\"auto\"",
      printable(values.name));
}

const std::vector<Check>& contradiction_checks() {
  static const std::vector<Check> checks = {
      {{"drop.shape", "solid.kind"}, nothing_to_simulate},
      {{"drop.material", "drop.shape", "drop.relaxation_time"}, several_drops_not_liquid},
      {{"drop.centre_y", "drop.placement", "solid.kind"}, height_of_a_drop_above_the_solid},
      {{"drop.oscillation_velocity", "drop.shape"}, oscillation_of_another_shape},
      {{"drop.velocity", "drop.shape"}, velocity_without_drop},
      {{"drop.material", "drop.shape"}, rigid_without_drop},
      {{"drop.oscillation_velocity", "drop.material"}, oscillation_of_a_rigid_drop},
      {{"drop.initial_spin", "drop.material"}, spin_of_a_liquid},
      {{"drop.density", "drop.material", "fluid.density"}, density_of_a_liquid},
      {{"fluid.gauge_pressure", "surface_tension.form", "surface_tension.coefficient"}, gauge_without_surface},
      {{"fluid.ambient_pressure", "fluid.gauge_pressure"}, ambient_pressure_without_gauge},
      {{"fluid.shifting", "surface_tension.form", "surface_tension.coefficient"}, shifting_without_surface},
      {{"drop.relaxation_time", "drop.shape", "drop.material"}, relaxation_of_another_drop},
      {{"drop.relaxation_time", "solid.initial_tip_velocity"}, relaxation_beside_a_swinging_beam},
      {{"drop.diameter", "resolution.spacing", "drop.shape"}, drop_too_small},
      {{"solid.length", "solid.kind"}, beam_without_length},
      {{"solid.thickness", "resolution.spacing", "solid.kind"}, rows_not_whole},
      {{"solid.length", "resolution.spacing", "solid.kind"}, length_not_whole},
      {{"solid.clamp_layers", "resolution.smoothing_ratio", "solid.kind", "solid.clamp"}, clamp_thinner_than_support},
      {{"solid.clamp_length", "resolution.smoothing_ratio", "resolution.spacing", "solid.kind", "solid.thickness"},
       clamp_shorter_than_support},
      {{"solid.initial_tip_velocity", "solid.kind"}, tip_velocity_of_another_solid},
      {{"solid.damping_rate", "solid.damping_ratio", "solid.viscous_time", "solid.kind"}, damping_of_another_solid},
      {{"solid.viscous_time", "solid.formulation"}, viscosity_of_another_formulation},
      {{"solid.damping_rate", "resolution.spacing", "solid.youngs_modulus", "solid.poisson_ratio", "solid.density",
        "resolution.smoothing_ratio", "fluid.sound_speed", "fluid.density", "fluid.viscosity", "drop.diameter",
        "surface_tension.coefficient", "gravity.acceleration", "time.end"},
       damping_within_a_step},
      {{"time.step",
        "resolution.spacing",
        "resolution.smoothing_ratio",
        "fluid.sound_speed",
        "fluid.density",
        "fluid.viscosity",
        "surface_tension.form",
        "surface_tension.coefficient",
        "solid.kind",
        "solid.youngs_modulus",
        "solid.poisson_ratio",
        "solid.density",
        "drop.shape",
        "drop.velocity",
        "drop.diameter",
        "drop.oscillation_velocity",
        "drop.material",
        "drop.initial_spin",
        "solid.initial_tip_velocity",
        "gravity.acceleration",
        "time.end"},
       step_too_large},
      {{"time.solid_substeps", "solid.kind", "solid.formulation", "drop.shape", "drop.material"},
       substeps_of_another_solid},
      {{"surface_tension.contact_angle", "surface_tension.form", "surface_tension.coefficient", "drop.shape",
        "drop.material", "solid.kind"},
       contact_angle_without_surface},
      {{"contact.stiffness", "contact.stiffness_form"}, contact_stiffer_than_a_step},
      {{"contact.stiffness",
        "contact.stiffness_form",
        "time.step",
        "time.sound_cfl",
        "resolution.spacing",
        "resolution.smoothing_ratio",
        "fluid.sound_speed",
        "fluid.density",
        "drop.shape",
        "drop.material",
        "drop.density",
        "drop.diameter",
        "drop.velocity",
        "drop.oscillation_velocity",
        "drop.initial_spin",
        "surface_tension.coefficient",
        "gravity.acceleration",
        "time.end",
        "solid.kind",
        "solid.density",
        "solid.youngs_modulus",
        "solid.poisson_ratio",
        "solid.initial_tip_velocity"},
       contact_springs_within_a_step},
      {{"time.step", "time.end"}, step_beyond_end},
      {{"resolution.spacing", "drop.shape", "drop.diameter", "solid.kind", "solid.length", "solid.thickness",
        "solid.clamp_length", "solid.clamp_layers"},
       too_many_particles},
      {{"name"}, name_not_a_file_name},
  };
  return checks;
}

}  // namespace

double particle_count(const Case& values) {
  const double d = values.resolution.spacing;
  double area = drop_area(values.drop);
  for (const Case::Drop& drop : values.more_drops) area += drop_area(drop);
  for (std::size_t k = 0; k < values.solid_count(); ++k) {
    const Case::Solid& solid = values.solid_at(k);
    if (solid.is_straight_beam()) {
      area += (solid.length + 2 * solid.clamp_length) * solid.thickness;
      area += 4 * solid.clamp_length * static_cast<double>(solid.clamp_layers) * d;
    }
    if (solid.kind == SolidKind::polygon) area += area_of(solid.polygon);
    if (solid.kind == SolidKind::rigid_wall) area += solid.length * d;
    if (solid.kind == SolidKind::obstacle) area += perimeter_of(solid.polygon) * d;
  }
  return area / (d * d);
}

std::vector<Finding> contradictions(const Case& values, const IsUsable& is_usable) {
  std::vector<Finding> findings = run_checks(contradiction_checks(), values, is_usable);
  for (const auto* checks : {&drop_contradictions(), &solid_contradictions()})
    for (Finding& finding : run_checks(*checks, values, is_usable)) findings.push_back(std::move(finding));
  return findings;
}

}  // namespace sphdrop
