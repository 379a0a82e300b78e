#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/check.hpp"
#include "config/consistency.hpp"
#include "config/derived_defaults.hpp"
#include "config/solid_checks.hpp"

namespace sphdrop {
namespace {

bool is_hypoelastic(const Case& values) {
  return values.solid.is_elastic() && values.solid.formulation == SolidFormulation::hypoelastic;
}

Verdict few_rows(const Case& values) {
  const double rows = std::round(rows_across(values));
  if (!values.solid.is_straight_beam() || rows >= 4) return {};
  return fmt::format("the beam has {} rows across its thickness; bending needs at least 4, better 10", rows);
}

Verdict odd_rows(const Case& values) {
  const double rows = std::round(rows_across(values));
  if (!is_hypoelastic(values) || !values.solid.is_straight_beam() || std::fmod(rows, 2) == 0) return {};
  return fmt::format(
      "the beam has {} rows, an odd number: it will be 2 to 3 times too stiff. Even ones are {} rows "
      "(resolution.spacing = {:.10g} m) and {} rows ({:.10g} m)",
      rows, rows - 1, values.solid.thickness / (rows - 1), rows + 1, values.solid.thickness / (rows + 1));
}

// method.md, 3a: critical coefficients .50, .43, .33, .15, .05 at h/d = 1.0, 1.05, 1.1, 1.2, 1.3 without viscosity;
// with it, 0.2 is stable at 1.2.
Verdict unstable_artificial_stress(const Case& values) {
  const double ratio = values.resolution.smoothing_ratio;
  const double eps = values.solid.artificial_stress_coefficient;
  if (!is_hypoelastic(values)) return {};
  const double limit = ratio <= 1.1 ? 0.5 : (ratio < 1.3 ? 0.25 : 0.05);
  if (ratio <= 1.1 ? eps <= limit : eps < limit) return {};
  return fmt::format(
      "solid.artificial_stress_coefficient = {} is unstable at h = {} d: a zigzag of the beam's particles "
      "grows. Take 0.2 or less at h = 1.2 d, or resolution.smoothing_ratio <= 1.1",
      eps, ratio);
}

// method.md, 4: cells are stable to 0.55 on h/c_s.
Verdict long_step_of_cells(const Case& values) {
  const bool is_cells = values.solid.is_elastic() && values.solid.formulation == SolidFormulation::cells;
  if (!is_cells || values.time.step > 0 || values.time.sound_cfl <= 0.5) return {};
  return fmt::format(
      "time.sound_cfl = {} is more than a beam of cells stands where its sound sets the step; take 0.5 or less",
      values.time.sound_cfl);
}

// The contact's impulses come once a step. Where that is longer than the period of the beam's fastest mode, 2 pi/omega,
// some mode is in step with them and rings louder and louder: measured with cells, energy + 2 % in an impact at 4
// sub-steps of 0.5 h/c_s, none at 3. omega is 2/0.55 c_s/h for cells, whose limit that is.
Verdict ringing_substeps(const Case& values) {
  constexpr double limit = 1.7;  // below pi 0.55
  const double h = values.resolution.smoothing_ratio * values.resolution.spacing;
  if (values.time.solid_substeps <= 1 || !can_take_substeps(values)) return {};
  const double step = values.time.step > 0 ? values.time.step : sound_step(values);
  const double share = step * largest_sound_speed(values) / h;
  if (share <= limit) return {};
  return fmt::format(
      "a step of {} sub-steps is {:.3g} of h/c_s: beyond {} the contact's impulses ring with the beam; take "
      "time.solid_substeps = 3 with time.sound_cfl = 0.5",
      values.time.solid_substeps, share, limit);
}

Verdict slow_sound(const Case& values) {
  if (!values.drop.is_liquid()) return {};
  const double fastest = expected_speed(values);
  if (values.fluid.sound_speed >= 10 * fastest) return {};
  return fmt::format(
      "fluid.sound_speed = {} m/s is less than 10 times the largest speed expected, {:.4g} m/s: the liquid will "
      "be compressed by more than 1 %. Take 50 times that speed",
      values.fluid.sound_speed, fastest);
}

Verdict inviscid(const Case& values) {
  const Case::Fluid& fluid = values.fluid;
  if (!values.drop.is_liquid() || fluid.viscosity_form == ViscosityForm::physical ||
      fluid.artificial_viscosity_alpha > 0)
    return {};
  return "fluid.artificial_viscosity_alpha = 0: the drop's particles will clump. Take 0.1, the paper's, or "
         "fluid.viscosity_form = \"physical\" with fluid.shifting = \"on\"";
}

Verdict inviscid_physically(const Case& values) {
  const Case::Fluid& fluid = values.fluid;
  if (!values.drop.is_liquid() || fluid.viscosity_form == ViscosityForm::artificial || fluid.viscosity > 0) return {};
  return "fluid.viscosity = 0 with fluid.viscosity_form = \"physical\": nothing damps the liquid, and its particles "
         "will clump";
}

// The leap-frog's predictor amplifies sound by (omega dt)^4/4 a step; water's own viscosity and the filter of the
// density outweigh that up to 0.2 (measured), the diffusion of the density up to 0.3.
Verdict long_step_for_water(const Case& values) {
  const Case::Fluid& fluid = values.fluid;
  if (!values.drop.is_liquid() || fluid.viscosity_form == ViscosityForm::artificial) return {};
  const double limit = fluid.density_treatment == DensityTreatment::density_diffusion ? 0.3 : 0.2;
  const double h = values.resolution.smoothing_ratio * values.resolution.spacing;
  const double share =
      fluid.sound_speed / h *
      (values.time.step > 0             ? values.time.step
       : values.time.solid_substeps > 1 ? sound_step(values)
                                        : values.time.sound_cfl * h / std::max(largest_sound_speed(values), 1e-300));
  if (share <= limit * (1 + 1e-9)) return {};
  return fmt::format(
      "the time step is {:.3g} of h/fluid.sound_speed: with fluid.viscosity_form = \"physical\" sound in the liquid "
      "may "
      "grow beyond {}; take time.sound_cfl <= {}",
      share, limit, limit);
}

Verdict uncorrected_density(const Case& values) {
  const Case::Fluid& fluid = values.fluid;
  const bool is_corrected =
      fluid.density_treatment == DensityTreatment::moving_least_squares && fluid.density_correction_interval > 0;
  const bool diffuses = fluid.density_treatment == DensityTreatment::density_diffusion && fluid.density_diffusion > 0;
  if (!values.drop.is_liquid() || is_corrected || diffuses) return {};
  const char* cause = fluid.density_treatment == DensityTreatment::none ? "fluid.density_treatment = \"none\""
                      : fluid.density_treatment == DensityTreatment::density_diffusion
                          ? "fluid.density_diffusion = 0"
                          : "fluid.density_correction_interval = 0";
  return fmt::format(
      "{}: without the correction all particles pair up and the curvature's noise triples. Take "
      "fluid.density_treatment = "
      "\"moving_least_squares\" with fluid.density_correction_interval = 20",
      cause);
}

// It falls off faster than the spline: at the same h its sums rest on fewer neighbours and are noisier.
Verdict narrow_wendland(const Case& values) {
  if (!values.drop.is_liquid() || values.resolution.kernel != KernelShape::wendland_c2 ||
      values.resolution.smoothing_ratio >= 1.3)
    return {};
  return fmt::format(
      "resolution.smoothing_ratio = {} is narrow for resolution.kernel = \"wendland_c2\", which falls off faster than "
      "the spline: take 1.5",
      values.resolution.smoothing_ratio);
}

Verdict stubby_beam(const Case& values) {
  if (!values.solid.is_straight_beam() || values.solid.length >= 4 * values.solid.thickness) return {};
  return fmt::format("solid.length = {} m is less than 4 thicknesses of {} m: beam theory does not describe it",
                     values.solid.length, values.solid.thickness);
}

// Millimetres taken for metres make a run that never ends; large runs on many ranks are meant.
Verdict many_particles(const Case& values) {
  constexpr double many = 1e7;
  const double count = particle_count(values);
  if (count < many) return {};
  return fmt::format("the case has about {:.2g} particles; if fewer were meant, check the units of the lengths (m)",
                     count);
}

const std::vector<Check>& doubt_checks() {
  static const std::vector<Check> checks = {
      {{"resolution.spacing", "drop.diameter", "solid.length"}, many_particles},
      {{"resolution.spacing", "solid.thickness"}, few_rows},
      {{"resolution.spacing", "solid.thickness"}, odd_rows},
      {{"solid.length", "solid.thickness"}, stubby_beam},
      {{"solid.artificial_stress_coefficient", "resolution.smoothing_ratio"}, unstable_artificial_stress},
      {{"time.sound_cfl", "solid.formulation", "time.step"}, long_step_of_cells},
      {{"time.solid_substeps", "time.sound_cfl", "time.step"}, ringing_substeps},
      {{"fluid.sound_speed", "drop.velocity", "drop.oscillation_velocity", "gravity.acceleration"}, slow_sound},
      {{"fluid.artificial_viscosity_alpha"}, inviscid},
      {{"fluid.viscosity"}, inviscid_physically},
      {{"time.sound_cfl", "time.step", "fluid.viscosity_form", "fluid.density_treatment"}, long_step_for_water},
      {{"fluid.density_correction_interval"}, uncorrected_density},
      {{"resolution.smoothing_ratio"}, narrow_wendland},
  };
  return checks;
}

}  // namespace

std::vector<Finding> doubts(const Case& values) {
  const auto all = [](std::string_view) { return true; };
  std::vector<Finding> findings = run_checks(doubt_checks(), values, all);
  for (Finding& finding : run_checks(solid_doubts(), values, all)) findings.push_back(std::move(finding));
  return findings;
}

}  // namespace sphdrop
