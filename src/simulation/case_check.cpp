#include "simulation/case_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "diagnostics/progress.hpp"
#include "diagnostics/theory.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {

namespace {

double bytes_of(const ParticleSet& set) {
  double columns = 1;
  for (const Field* field : set.fields()) columns += field->components;
  return columns * 8.0 * static_cast<double>(set.size());
}

double bytes_of(const SlicedNeighbours& list) {
  return 4.0 * static_cast<double>(list.neighbours.size());
}

}  // namespace

std::string check_case(const Communicator& communicator, const Case& c, const InitialState& initial) {
  constexpr int warm_up = 5, timed = 40;
  Simulation simulation(communicator, c, initial.fluid, initial.solid);
  std::chrono::steady_clock::time_point start;
  for (int k = 0; k < warm_up + timed; ++k) {
    if (k == warm_up) {
      communicator.barrier();
      start = std::chrono::steady_clock::now();
    }
    simulation.evaluate();
    simulation.move();
  }
  communicator.barrier();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / timed;

  const std::int64_t fluid = simulation.fluid_total(), solid = simulation.solid_total();
  const double step = simulation.time_step();
  const double steps = std::ceil((c.time.end + c.drop.relaxation_time) / step);
  // Ghosts, lists and the sweep's records included; the mean over ranks.
  const Distribution& distribution = simulation.distribution();
  const double mine = bytes_of(simulation.fluid()) + bytes_of(simulation.solid()) +
                      64.0 * static_cast<double>(simulation.fluid().size()) + bytes_of(distribution.inner_fluid()) +
                      bytes_of(distribution.border_fluid());
  const double bytes = static_cast<double>(communicator.sum(static_cast<std::int64_t>(mine)));
  const auto ghosts =
      communicator.sum(static_cast<std::int64_t>(simulation.fluid().size() - simulation.fluid().owned_count() +
                                                 simulation.solid().size() - simulation.solid().owned_count()));
  const auto largest =
      communicator.max(static_cast<std::int64_t>(simulation.fluid().owned_count() + simulation.solid().owned_count()));
  const auto smallest =
      communicator.min(static_cast<std::int64_t>(simulation.fluid().owned_count() + simulation.solid().owned_count()));

  std::string text = fmt::format("case                {}\n", c.name);
  text += fmt::format("particles           {} {} + {} solid = {}\n", fluid, c.drop.is_rigid() ? "rigid drop" : "liquid",
                      solid, fluid + solid);
  text += fmt::format("spacing d           {:.6g} mm, smoothing length {:.6g} mm\n", 1e3 * c.resolution.spacing,
                      1e3 * simulation.parameters().smoothing_length);
  text += fmt::format("time step           {:.4g} ns{}\n", 1e9 * step,
                      c.time.step > 0     ? ""
                      : c.drop.is_rigid() ? " (Eq 40)"
                                          : " (Eqs 40-42)");
  text += fmt::format(
      "steps               {:.0f} for {:.6g} ms{}\n", steps, 1e3 * c.time.end,
      c.drop.relaxation_time > 0 ? fmt::format(" and {:.6g} ms of rest before", 1e3 * c.drop.relaxation_time) : "");
  text += fmt::format("memory              {:.3g} MB for particles and lists, all ranks\n", 1e-6 * bytes);
  text += fmt::format("expected wall time  {} on {} rank{} ({:.3g} us a step, measured over {})\n",
                      hours_minutes_seconds(steps * seconds), communicator.size(), communicator.size() == 1 ? "" : "s",
                      1e6 * seconds, timed);
  text += fmt::format(
      "partition           {} to {} particles a rank, {} ghosts in all, load imbalance {:.3f}, {} of {} cells' edges "
      "cut\n",
      smallest, largest, ghosts, distribution.quality().imbalance, distribution.quality().cut_edges,
      distribution.quality().occupied_cells);

  const double speed = std::hypot(c.drop.velocity_x, c.drop.velocity_y);
  if (c.drop.is_liquid()) {
    const double sigma = c.surface_tension.coefficient;
    if (speed > 0 && sigma > 0)
      text += fmt::format("Weber number        {:.4g}\n", weber_number(c.fluid.density, speed, c.drop.diameter, sigma));
    const double length = c.drop.diameter, mu = c.fluid.viscosity;
    if (speed > 0 && mu > 0) {
      text += fmt::format("Reynolds number     {:.4g} by fluid.viscosity",
                          reynolds_number(c.fluid.density, speed, length, mu));
      const double artificial =
          c.fluid.artificial_viscosity_alpha * c.fluid.sound_speed * simulation.parameters().smoothing_length / 16;
      text += c.fluid.viscosity_form == ViscosityForm::physical
                  ? "\n"
                  : fmt::format("; the artificial viscosity is about {:.3g} m2/s: {:.4g}\n", artificial,
                                speed * length / artificial);
    }
  }
  if (c.drop.is_rigid()) {
    const RigidBody& body = simulation.rigid_body().body();
    text += fmt::format("rigid drop          {:.6g} kg/m, moment of inertia {:.6g} kg m2/m\n", body.mass,
                        body.moment_of_inertia);
  }
  if (c.solid.has_theory()) {
    const BeamProperties beam{c.solid.youngs_modulus, c.solid.poisson_ratio, c.solid.density, c.solid.length,
                              c.solid.thickness};
    const bool is_cantilever = c.solid.kind == SolidKind::cantilever;
    const double omega = is_cantilever ? cantilever_angular_frequency(beam) : fixed_fixed_angular_frequency(beam);
    text += fmt::format("beam's first period {:.4g} ms in theory (Eqs 43, 44)\n", 1e3 * period_of(omega));
    if (is_cantilever && c.solid.initial_tip_velocity != 0)
      text += fmt::format("swing of its end    {:.4g} mm to either side in theory\n",
                          1e3 * std::abs(c.solid.initial_tip_velocity) / omega);
    if (c.gravity.y < 0)
      text += fmt::format("depth under weight  {:.4g} mm of {} at rest, in theory for small slopes\n",
                          1e3 * (is_cantilever ? cantilever_depth_under_weight(beam, -c.gravity.y)
                                               : fixed_fixed_depth_under_weight(beam, -c.gravity.y)),
                          is_cantilever ? "the free end" : "mid-span");
    if (simulation.parameters().damping_rate.front() > 0)
      text += fmt::format("damping of the beam {:.4g} of critical in its first mode\n",
                          damping_ratio(simulation.parameters().damping_rate.front(), omega));
    if (is_cantilever && c.drop.shape == DropShape::round && c.drop.velocity_y < 0) {
      const double depth =
          cantilever_largest_deflection(beam, round_drop_mass(c.drop.density, c.drop.diameter), -c.drop.velocity_y);
      text += fmt::format("largest deflection  {:.4g} mm by Eq 46, {:.3g} of the length\n", 1e3 * depth,
                          relative_deflection(depth, c.solid.length));
    }
    text += fmt::format("rows across         {:.0f}\n", std::round(c.solid.thickness / c.resolution.spacing));
  }
  return text;
}

}  // namespace sphdrop
