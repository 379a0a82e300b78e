#pragma once
// What is watched in a run (method.md, section 7), and the table from which history.csv follows.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "simulation/simulation.hpp"

namespace sphdrop {

/// One of several solids at one instant; NaN for what does not yield.
struct SolidObservation {
  double deflection, displacement_x;        ///< m
  double contact_force_x, contact_force_y;  ///< N/m
};

/// The watched quantities at one instant, per metre of depth; the same on every rank, and the same bits for any number
/// of them. NaN for what the case does not have.
struct Observation {
  double time, step, time_step;
  double drop_width, drop_height, deflection, middle_deflection, tip_displacement_x;
  double drop_centre_x, drop_centre_y, drop_velocity_x, drop_velocity_y;
  double drop_angle, drop_spin;
  double drop_elongation, quarter_centre_x, quarter_centre_y;
  double mean_pressure, gauge_pressure, curve_length, curve_area, mean_curvature, curvature_scatter, curve_count,
      tension_net_force;
  double base_width;
  double contact_count, contact_force_x, contact_force_y, contact_impulse_x, contact_impulse_y;
  double contact_angular_impulse;
  double kinetic_fluid, kinetic_solid, elastic, compressive, surface, adhesion, contact, gravity;
  double gauge;
  double dissipated_fluid, dissipated_solid, dissipated_contact, density_correction, artificial_stress_work,
      reconnection;
  double gauge_adjustment, shifting_work, sharing_work;
  double total, unaccounted;
  double momentum_fluid_x, momentum_fluid_y, momentum_solid_x, momentum_solid_y;
  double angular_momentum_fluid, angular_momentum_solid;
  double largest_density_error;
  std::vector<SolidObservation> solids;  ///< of several; empty where there is one or none
};

/// Collective. Looks at the state between evaluate() and move(). `initial_total` is the total energy of the first
/// observation, from which `unaccounted` counts.
Observation observe(const Simulation& simulation, double initial_total);

/// The 64-bit hash over id, position, velocity, density and stress of every particle at the present instant, to which
/// it brings them all; collective, between evaluate() and move().
std::uint64_t state_hash(Simulation& simulation);

struct ObservedQuantity {
  std::string_view name, unit, description;
  double Observation::*value;
};

/// Every quantity of an Observation, in the order of history.csv's columns.
std::span<const ObservedQuantity> observed_quantities();

struct SolidQuantity {
  std::string_view name, unit, description;
  double SolidObservation::*value;
};

/// Those of each of several solids, which follow in history.csv with the solid's number behind the name.
std::span<const SolidQuantity> solid_quantities();

}  // namespace sphdrop
