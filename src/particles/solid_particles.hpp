#pragma once
// The table of the solid's quantities. "Staggered" values belong to the half step before position (leap-frog).

#include "particles/particle_set.hpp"

namespace sphdrop {

class SolidParticles : public ParticleSet {
 public:
  ScalarField mass{*this, "mass", "kg/m", Role::state | Role::constant | Role::written, "mass per metre of depth"};
  ScalarField is_fixed{*this, "is_fixed", "1", Role::state | Role::constant | Role::written,
                       "1 for particles that a clamp or a wall holds, 0 for those that move"};
  VectorField reference_position{*this, "reference_position", "m", Role::state | Role::constant,
                                 "position in the undeformed body"};
  VectorField position{*this, "position", "m", Role::state | Role::ghosted | Role::written, "position", far_away};
  VectorField staggered_velocity{*this, "staggered_velocity", "m/s", Role::state, "velocity half a step back"};
  ScalarField staggered_density{*this, "staggered_density", "kg/m3", Role::state, "density half a step back"};
  TensorField staggered_deviatoric_stress{*this, "staggered_deviatoric_stress", "Pa", Role::state,
                                          "deviatoric stress half a step back"};
  VectorField acceleration{*this, "acceleration", "m/s2", Role::state, "total acceleration of the last step"};
  ScalarField density_rate{*this, "density_rate", "kg/m3/s", Role::state, "rate of density of the last step (9)"};
  TensorField deviatoric_stress_rate{*this, "deviatoric_stress_rate", "Pa/s", Role::state,
                                     "rate of the deviatoric stress of the last step (6)"};
  ScalarField dissipated_energy{*this, "dissipated_energy", "J/m", Role::state, "heat made by viscosity so far"};
  ScalarField artificial_stress_work{*this, "artificial_stress_work", "J/m", Role::state,
                                     "work done by the artificial stress so far"};

  VectorField velocity{*this, "velocity", "m/s", Role::ghosted | Role::written, "velocity"};
  ScalarField density{*this, "density", "kg/m3", Role::ghosted | Role::written, "density", 1.0};
  TensorField deviatoric_stress{*this, "deviatoric_stress", "Pa", Role::ghosted, "deviatoric stress tau"};
  ScalarField pressure{*this, "pressure", "Pa", Role::written, "pressure (5)"};
  ScalarField volume{*this, "volume", "m2", Role::derived, "m/rho: area of the plane"};
  TensorField stress{*this, "stress", "Pa", Role::written, "total stress sigma = -p I + tau"};
  TensorField artificial_stress{*this, "artificial_stress", "Pa m6/kg2", Role::derived, "R of Eqs 19-23"};
  ScalarField dissipation_rate{*this, "dissipation_rate", "W/kg", Role::derived, "specific heating by viscosity"};
  ScalarField artificial_stress_power{*this, "artificial_stress_power", "W/kg", Role::derived,
                                      "specific power of the artificial stress"};
  VectorField list_position{*this, "list_position", "m", Role::derived, "position when neighbours were last listed"};
};

}  // namespace sphdrop
