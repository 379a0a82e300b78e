#include "simulation/case_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "diagnostics/progress.hpp"
#include "simulation/case_numbers.hpp"
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
  if (c.time.solid_substeps > 1)
    text += fmt::format("sub-steps of solid  {} a step, {:.4g} ns each\n", c.time.solid_substeps,
                        1e9 * step / static_cast<double>(c.time.solid_substeps));
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

  text += case_numbers_text(simulation);
  return text;
}

}  // namespace sphdrop
