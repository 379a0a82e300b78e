#include "simulation/case_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "diagnostics/impact_estimates.hpp"
#include "diagnostics/theory.hpp"

namespace sphdrop {

namespace {

// Rows and columns that the cases shipped and method.md's measurements have.
constexpr double fine_drop = 40, coarse_drop = 20, thin_film = 4, fine_beam = 10, fast_sound = 50;

// Of the first drop; 0 where it does not fall.
double impact_speed(const Case& c) {
  return c.drop.velocity_y < 0 ? -c.drop.velocity_y : 0.0;
}

std::string viscous_number(const Case& c, double speed, double smoothing_length) {
  const double length = c.drop.diameter, mu = c.fluid.viscosity;
  if (!(speed > 0 && mu > 0)) return {};
  const double by_viscosity = reynolds_number(c.fluid.density, speed, length, mu);
  if (c.fluid.viscosity_form == ViscosityForm::physical)
    return fmt::format("Reynolds number     {:.4g} by fluid.viscosity\n", by_viscosity);
  const double artificial = c.fluid.artificial_viscosity_alpha * c.fluid.sound_speed * smoothing_length / 16;
  if (!(artificial > 0)) return {};
  return fmt::format(
      "Reynolds number     {:.4g}: the artificial viscosity is about {:.3g} m2/s (by fluid.viscosity: {:.4g})\n",
      speed * length / artificial, artificial, by_viscosity);
}

// What decides how good the picture of the liquid is.
std::string resolution_of_drop(const Case& c, double speed) {
  const double across = c.drop.diameter / c.resolution.spacing;
  std::string text =
      fmt::format("spacings across     {:.3g} in the drop{}\n", across,
                  across < coarse_drop ? fmt::format(": coarse; the paper's runs have {:g}", fine_drop) : "");
  if (!(speed > 0)) return text;
  const double ratio = c.fluid.sound_speed / speed;
  text += fmt::format("sound speed         {:.3g} times the drop's{}\n", ratio,
                      ratio < fast_sound * (1 - 1e-9)
                          ? fmt::format(": less than the {:g} times it that keep the liquid's density", fast_sound)
                          : "");
  return text;
}

// The contact time on a wall, s, if it can be told.
std::optional<double> describe_impact(const Case& c, std::string& text) {
  const double speed = impact_speed(c), sigma = c.surface_tension.coefficient;
  const bool is_impact = c.drop.shape == DropShape::round && c.has_solid() && speed > 0 && sigma > 0 &&
                         c.surface_tension.form != SurfaceTensionForm::none && !c.is_wetting();
  if (!is_impact) return std::nullopt;
  const double weber = weber_number(c.fluid.density, speed, c.drop.diameter, sigma);
  if (weber < least_fitted_weber_number || weber > largest_fitted_weber_number) {
    text += fmt::format("on a rigid wall     no estimate: it has been fitted for Weber numbers of {:g} to {:g}\n",
                        least_fitted_weber_number, largest_fitted_weber_number);
    return std::nullopt;
  }
  const double spread = expected_spread(weber);
  const double period = drop_oscillation_period(c.fluid.density, c.drop.diameter / 2, sigma);
  const double contact_time = expected_contact_time(period, spread);
  const double rows = film_thickness(c.drop.diameter, spread) / c.resolution.spacing;
  text +=
      fmt::format("on a rigid wall     D_max about {:.3g} D0, {:.3g} mm; its film has {:.2g} spacings{}\n", spread,
                  1e3 * spread * c.drop.diameter, rows, rows < thin_film ? ": it may tear; take a finer spacing" : "");
  text += fmt::format(
      "contact time        about {:.3g} ms there, by this program's runs; the paper's is {:.3g} ms at any speed\n",
      1e3 * contact_time, 1e3 * contact_time_of_the_paper(period));
  return contact_time;
}

std::optional<double> describe_liquid(const Case& c, double smoothing_length, std::string& text) {
  const double speed = std::hypot(c.drop.velocity_x, c.drop.velocity_y), sigma = c.surface_tension.coefficient;
  const bool has_tension = sigma > 0 && c.surface_tension.form != SurfaceTensionForm::none;
  if (speed > 0 && has_tension)
    text += fmt::format("Weber number        {:.4g}\n", weber_number(c.fluid.density, speed, c.drop.diameter, sigma));
  text += viscous_number(c, speed, smoothing_length);
  const double g = std::hypot(c.gravity.x, c.gravity.y);
  if (g > 0 && has_tension)
    text += fmt::format("Bond number         {:.4g}\n", bond_number(c.fluid.density, g, c.drop.diameter, sigma));
  text += resolution_of_drop(c, speed);
  return describe_impact(c, text);
}

void describe_beam(const Case& c, double damping_rate, std::optional<double> contact_time, std::string& text) {
  const BeamProperties beam{c.solid.youngs_modulus, c.solid.poisson_ratio, c.solid.density, c.solid.length,
                            c.solid.thickness};
  const bool is_cantilever = c.solid.kind == SolidKind::cantilever;
  const double omega = is_cantilever ? cantilever_angular_frequency(beam) : fixed_fixed_angular_frequency(beam);
  const double rows = std::round(c.solid.thickness / c.resolution.spacing);
  text += fmt::format("rows across         {:.0f} in the beam{}\n", rows,
                      rows < fine_beam && c.solid.formulation == SolidFormulation::hypoelastic
                          ? fmt::format("; the paper's runs have {:g}", fine_beam)
                          : "");
  text +=
      fmt::format("beam's first period {:.4g} ms in theory (Eqs 43, 44){}\n", 1e3 * period_of(omega),
                  contact_time ? fmt::format(", {:.3g} of that contact time", period_of(omega) / *contact_time) : "");
  if (is_cantilever && c.solid.initial_tip_velocity != 0)
    text += fmt::format("swing of its end    {:.4g} mm to either side in theory\n",
                        1e3 * std::abs(c.solid.initial_tip_velocity) / omega);
  if (c.gravity.y < 0)
    text += fmt::format("depth under weight  {:.4g} mm of {} at rest, in theory for small slopes\n",
                        1e3 * (is_cantilever ? cantilever_depth_under_weight(beam, -c.gravity.y)
                                             : fixed_fixed_depth_under_weight(beam, -c.gravity.y)),
                        is_cantilever ? "the free end" : "mid-span");
  if (damping_rate > 0)
    text +=
        fmt::format("damping of the beam {:.4g} of critical in its first mode\n", damping_ratio(damping_rate, omega));
  if (is_cantilever && c.drop.shape == DropShape::round && c.drop.velocity_y < 0) {
    const double depth =
        cantilever_largest_deflection(beam, round_drop_mass(c.drop.density, c.drop.diameter), -c.drop.velocity_y);
    text += fmt::format("largest deflection  {:.4g} mm by Eq 46, {:.3g} of the length\n", 1e3 * depth,
                        relative_deflection(depth, c.solid.length));
  }
}

}  // namespace

std::string case_numbers_text(const Simulation& simulation) {
  const Case& c = simulation.input();
  std::string text;
  std::optional<double> contact_time;
  if (c.drop.is_liquid()) contact_time = describe_liquid(c, simulation.parameters().smoothing_length, text);
  if (c.drop.is_rigid()) {
    const RigidBody& body = simulation.rigid_body().body();
    text += fmt::format("rigid drop          {:.6g} kg/m, moment of inertia {:.6g} kg m2/m\n", body.mass,
                        body.moment_of_inertia);
  }
  if (c.solid.has_theory()) describe_beam(c, simulation.parameters().damping_rate.front(), contact_time, text);
  return text;
}

}  // namespace sphdrop
