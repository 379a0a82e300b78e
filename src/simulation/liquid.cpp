// What is done with the liquid between its prediction and its sweep, and after it.

#include <algorithm>
#include <cmath>

#include "diagnostics/energy.hpp"
#include "fluid/density_correction.hpp"
#include "fluid/density_diffusion.hpp"
#include "setup/placed_drop.hpp"
#include "simulation/particle_transport.hpp"
#include "simulation/simulation.hpp"
#include "sph/equation_of_state.hpp"

namespace sphdrop {

bool Simulation::has_density_diffusion() const {
  return case_.drop.is_liquid() && case_.fluid.density_treatment == DensityTreatment::density_diffusion &&
         case_.fluid.density_diffusion > 0;
}

bool Simulation::density_correction_is_due() const {
  const std::int64_t interval = case_.fluid.density_correction_interval;
  return case_.fluid.density_treatment == DensityTreatment::moving_least_squares && interval > 0 && step_ > 0 &&
         step_ % interval == 0;
}

void Simulation::predict_liquid() {
  if (gauge_.is_enabled()) gauge_.relax(fluid_, steps_.previous);
  const bool is_corrected = density_correction_is_due();
  const auto make_ready = [&](std::span<const RowRange> rows) {
    set_liquid_pressure(rows);
    fluid_sweep_.pack(fluid_, rows, gauge_.pressure());
  };
  if (!is_corrected && !has_density_diffusion()) {
    for_each_run(fluid_.owned, [&](std::span<const RowRange> rows) {
      predict(fluid_, rows, steps_.previous);
      make_ready(rows);
    });
    return;
  }
  predict(fluid_, steps_.previous);
  timer_.lap(Phase::update);
  if (is_corrected) correct_density();
  if (has_density_diffusion()) find_density_gradients();
  for_each_run(fluid_.owned, make_ready);
}

void Simulation::set_liquid_pressure(std::span<const RowRange> rows) {
  const double gauge = gauge_.pressure();
  for (const RowRange& range : rows)
    for (std::int32_t k = range.begin; k < range.end; ++k) {
      const auto row = static_cast<std::size_t>(k);
      fluid_.pressure[row] =
          equation_of_state_pressure(fluid_.density[row], case_.fluid.sound_speed, case_.fluid.density) + gauge;
    }
}

void Simulation::exchange_densities() {
  start_exchange(distribution_.fluid_halo(), correction_ghosted_);
  finish_exchange(distribution_.fluid_halo(), correction_ghosted_);
  timer_.lap(Phase::communication);
}

void Simulation::correct_density() {
  exchange_densities();
  for (const SlicedNeighbours* list : {&distribution_.inner_fluid(), &distribution_.border_fluid()})
    moving_least_squares_densities(fluid_, *list, parameters_.kernel, case_.resolution.spacing, corrected_density_);
  // The staggered density is shifted by the same increment, so that the filter is not undone by the next step.
  const double reference = case_.fluid.density, sound_speed = case_.fluid.sound_speed;
  fluid_.for_each_owned([&](std::size_t row) {
    const double before = fluid_.staggered_density[row], change = corrected_density_[row] - fluid_.density[row];
    const double after = before + change;
    fluid_.staggered_density[row] = after;
    fluid_.density[row] = corrected_density_[row];
    // At the half step: from there on the corrected pressures act.
    fluid_.correction_energy[row] += fluid_.mass[row] * (compressive_energy_per_mass(after, reference, sound_speed) -
                                                         compressive_energy_per_mass(before, reference, sound_speed));
  });
  timer_.lap(Phase::fluid_sweep);
}

void Simulation::find_density_gradients() {
  exchange_densities();
  for (const SlicedNeighbours* list : {&distribution_.inner_fluid(), &distribution_.border_fluid()})
    density_gradients(fluid_, *list, parameters_.kernel);
  timer_.lap(Phase::fluid_sweep);
}

void Simulation::sweep_liquid(const SlicedNeighbours& list) {
  fluid_sweep_.apply(fluid_, list);
  if (!has_density_diffusion()) return;
  add_density_diffusion(fluid_, list, parameters_.kernel,
                        case_.fluid.density_diffusion * parameters_.smoothing_length * case_.fluid.sound_speed);
}

// Of the compressive energy: its rate is p/rho^2 times the density's, p that of the density, without the gauge.
void Simulation::account_for_density_diffusion() {
  fluid_.for_each_owned([&](std::size_t row) {
    const double rho = fluid_.density[row], pressure = fluid_.pressure[row] - gauge_.pressure();
    fluid_.correction_energy[row] +=
        fluid_.mass[row] * (pressure / (rho * rho) * fluid_.density_diffusion[row]) * steps_.kick();
  });
}

void Simulation::find_shift(double largest_speed) {
  shifting_.find(fluid_, distribution_, contact_, largest_speed, steps_.next);
  surface_tension_.add_energy_of_displacement(shifting_.displacement_x(), shifting_.displacement_y(), gauge_.pressure(),
                                              contact_, shifting_.work());
}

void Simulation::damp_resting_drop() {
  // Velocities fall by e^-10 in the time there is.
  const double rate = 10.0 / case_.drop.relaxation_time;
  fluid_.for_each_owned([&](std::size_t row) {
    const Vector v = fluid_.velocity.at(row);
    fluid_.acceleration.x[row] -= rate * v.x;
    fluid_.acceleration.y[row] -= rate * v.y;
  });
}

void Simulation::start_drop() {
  fluid_.for_each_owned([&](std::size_t row) {
    fluid_.staggered_velocity.set(row, drop_velocity(case_, fluid_.position.at(row) - drop_centre_));
  });
  for (ScalarField* energy :
       {&fluid_.dissipated_energy, &fluid_.correction_energy, &fluid_.shift_energy, &fluid_.gauge_energy})
    std::fill(energy->columns[0].begin(), energy->columns[0].end(), 0.0);
  surface_tension_.start_ledger();
  gauge_.start_ledger();
  shifting_.start_ledger();
  steps_.previous = 0;  // velocities now belong to this instant, as those of a run's beginning do
}

}  // namespace sphdrop
