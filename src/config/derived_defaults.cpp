#include "config/derived_defaults.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "config/polygon.hpp"
#include "config/several_drops.hpp"

namespace sphdrop {
namespace {

double speed(double x, double y) {
  return std::sqrt(x * x + y * y);
}

// c_s = sqrt(K/rho).
double beam_sound_speed(const Case& values) {
  if (!values.solid.is_elastic()) return 0;
  const double bulk_modulus = values.solid.youngs_modulus / (3 * (1 - 2 * values.solid.poisson_ratio));
  return std::sqrt(bulk_modulus / values.solid.density);
}

// Where the paper lets the drop fall: above the free end of a cantilever with its rim over the tip (method.md, 7), else
// above the middle.
double default_centre(const Case& values) {
  if (values.solid.kind == SolidKind::cantilever) return values.solid.length - values.drop.diameter / 2;
  if (values.solid.kind == SolidKind::fixed_fixed_beam) return values.solid.length / 2;
  const Extent extent = extent_of(values.solid.polygon);
  return values.solid.has_polygon() ? 0.5 * (extent.low.x + extent.high.x) : 0;
}

// Of the drop's particle farthest from its centre.
double largest_radius(const Case& values) {
  const double half_width = values.drop.diameter / 2;
  if (values.drop.shape == DropShape::ellipse)
    return half_width * std::sqrt(std::max(values.drop.aspect_ratio, 1 / values.drop.aspect_ratio));
  if (values.drop.given) return values.drop.given->largest_radius();
  return values.drop.shape == DropShape::square ? std::numbers::sqrt2 * half_width : half_width;
}

double longest_solid(const Case& values) {
  return largest_over_solids(
      values, [](const Case& one) { return one.solid.kind == SolidKind::none ? 0.0 : one.solid.length; });
}

// What gravity adds until time.end, m/s. A beam is held: by itself it falls no farther than its length.
double speed_by_gravity(const Case& values) {
  const double g = speed(values.gravity.x, values.gravity.y);
  const double free_fall = g * values.time.end;
  return has_beam(values) && !has_drop(values) ? std::min(free_fall, std::sqrt(2 * g * longest_solid(values)))
                                               : free_fall;
}

// No particle gets here in a sound run: twice what free flight at the expected speed covers, plus the largest body. A
// beam by itself does not fly: twice its length is as good as any distance.
double default_domain_margin(const Case& all) {
  return largest_over_drops(all, [](const Case& values) {
    double body = values.resolution.spacing;
    const bool is_long = values.drop.shape == DropShape::ellipse || values.drop.given;
    if (has_drop(values)) body = std::max(body, is_long ? 2 * largest_radius(values) : values.drop.diameter);
    body = std::max(body, longest_solid(values));
    const double flight = 2 * expected_speed(values) * values.time.end;
    const bool is_held = has_beam(values) && !has_drop(values);
    return (is_held ? std::min(flight, 2 * longest_solid(values)) : flight) + body;
  });
}

// Eq 40 of sound and the speed expected with these factors.
double sound_step(const Case& values, double factor, double liquid_factor) {
  const double h = values.resolution.smoothing_ratio * values.resolution.spacing, u = expected_speed(values);
  if (values.time.solid_substeps <= 1) return factor * h / (largest_sound_speed(values) + u);
  return std::min(static_cast<double>(values.time.solid_substeps) * factor * h /
                      (largest_over_solids(values, beam_sound_speed) + u),
                  liquid_factor * h / (values.fluid.sound_speed + u));
}

constexpr double cfl_of_substeps = 0.5;

// As many as bring the solid's step nearest to the liquid's, as long as contact does not ring (ringing_substeps).
std::int64_t default_substeps(const Case& values) {
  constexpr double most = 3;
  if (!can_take_substeps(values)) return 1;
  const double factor = std::isnan(values.time.sound_cfl) ? cfl_of_substeps : values.time.sound_cfl;
  const double ratio =
      values.time.liquid_sound_cfl / values.fluid.sound_speed * largest_over_solids(values, beam_sound_speed) / factor;
  return static_cast<std::int64_t>(std::clamp(std::round(ratio), 1.0, most));
}

// The largest that stay stable, with something to spare: cells stand 0.5 by their own c_s, water 0.2 by its c_f.
double default_sound_cfl(const Case& values) {
  if (values.mode == Mode::paper) return 0.1;
  if (values.time.solid_substeps > 1) return cfl_of_substeps;
  constexpr double of_solid = 0.4, of_liquid = 0.2;
  if (!values.drop.is_liquid()) return of_solid;
  return std::min(of_solid, of_liquid * largest_sound_speed(values) / values.fluid.sound_speed);
}

void fill(double& value, double automatic) {
  if (std::isnan(value)) value = automatic;
}

// Of the drop of `one`, which may be the case itself.
void fill_drop(Case& one, const Case& values) {
  const double d = values.resolution.spacing;
  fill(one.drop.density, values.fluid.density);
  fill(one.drop.gap, std::max(0.0, values.contact.distance_ratio - 1) * d + 0.1 * d);
  fill(one.drop.centre_x, default_centre(one) + one.solid.origin_x);
}

void fill_solid(Case::Solid& solid, const Case& values) {
  if (solid.formulation == SolidFormulation::automatic)
    solid.formulation = values.mode == Mode::paper ? SolidFormulation::hypoelastic : SolidFormulation::cells;
  if (solid.has_polygon()) {
    const Extent extent = extent_of(solid.polygon);
    fill(solid.length, std::max(extent.high.x - extent.low.x, extent.high.y - extent.low.y));
    solid.clamp = Clamp::ideal;  // strips follow straight sides alone
  } else if (std::isnan(solid.length) && !solid.is_elastic()) {
    const double d = values.resolution.spacing;
    solid.length = std::max(1.0, std::round(8 * values.drop.diameter / d)) * d;  // whole spacings
  }
  fill(solid.clamp_length, 2 * solid.thickness);
}

}  // namespace

bool has_drop(const Case& values) {
  return values.drop.shape != DropShape::none;
}

bool has_beam(const Case& values) {
  return values.has_elastic_solid();
}

double expected_speed(const Case& all) {
  return largest_over_drops(all, [](const Case& values) {
    double fastest = 0;
    if (has_drop(values)) {
      fastest = speed(values.drop.velocity_x, values.drop.velocity_y) + std::abs(values.drop.oscillation_velocity);
      if (values.drop.given) fastest += values.drop.given->largest_speed();
      if (values.drop.is_rigid()) fastest += std::abs(values.drop.initial_spin) * largest_radius(values);
      if (values.drop.is_liquid() && values.surface_tension.form != SurfaceTensionForm::none) {
        fastest = std::max(
            fastest, std::sqrt(2 * values.surface_tension.coefficient / (values.fluid.density * values.drop.diameter)));
      }
    }
    for (std::size_t k = 0; k < values.solid_count(); ++k)
      if (values.solid_at(k).is_elastic())
        fastest = std::max(fastest, std::abs(values.solid_at(k).initial_tip_velocity));
    return fastest + speed_by_gravity(values);
  });
}

double largest_sound_speed(const Case& values) {
  if (!has_beam(values)) return has_drop(values) ? values.fluid.sound_speed : 0;
  const double liquid = values.drop.is_liquid() ? values.fluid.sound_speed : 0;
  return std::max(liquid, largest_over_solids(values, beam_sound_speed));
}

double sound_step(const Case& values) {
  return sound_step(values, values.time.sound_cfl, values.time.liquid_sound_cfl);
}

bool can_take_substeps(const Case& values) {
  return has_beam(values) && values.drop.is_liquid() &&
         (values.solid.formulation == SolidFormulation::cells ||
          values.solid.formulation == SolidFormulation::total_lagrangian);
}

StepBound largest_step(const Case& values) {
  const double h = values.resolution.smoothing_ratio * values.resolution.spacing;
  const double rho = values.fluid.density;
  const double sigma = values.surface_tension.coefficient;
  const double mu = values.fluid.viscosity;
  StepBound bound{sound_step(values, 1.0, 1.0), "Eq 40 (sound)"};
  if (values.drop.is_liquid() && values.surface_tension.form != SurfaceTensionForm::none && sigma > 0) {
    const double capillary = std::sqrt(rho * h * h * h / (2 * std::numbers::pi * sigma));  // Eq 41
    if (capillary < bound.step) bound = {capillary, "Eq 41 (capillary waves)"};
  }
  if (values.drop.is_liquid() && mu > 0) {
    const double viscous = rho * h * h / mu;  // Eq 42
    if (viscous < bound.step) bound = {viscous, "Eq 42 (viscosity)"};
  }
  return bound;
}

void fill_names(Case& values, const std::string& source_name) {
  if (values.name.empty()) values.name = std::filesystem::path(source_name).stem().string();
  if (values.output.directory.empty()) values.output.directory = "results/" + values.name;
}

void fill_derived_defaults(Case& values) {
  fill_solid(values.solid, values);
  for (Case::Solid& solid : values.more_solids) fill_solid(solid, values);

  fill(values.time.step, 0);
  if (values.time.solid_substeps == 0) values.time.solid_substeps = default_substeps(values);
  fill(values.time.sound_cfl, default_sound_cfl(values));
  const bool springs_are_fixed = values.contact.stiffness_form == ContactStiffness::fixed;
  fill(values.contact.stiffness, springs_are_fixed ? 0.3 : 0.1);
  fill(values.contact.overlap_limit, springs_are_fixed ? 0.5 : 0.2);
  fill_drop(values, values);
  for (Case::Drop& drop : values.more_drops) {
    Case one = values;
    one.drop = drop;
    fill_drop(one, values);
    drop = one.drop;
  }
  fill(values.safety.speed_limit, values.fluid.sound_speed);
  fill(values.safety.domain_margin, default_domain_margin(values));
}

}  // namespace sphdrop
