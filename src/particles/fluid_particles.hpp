#pragma once
// The table of the liquid's quantities. "Staggered" values belong to the half step before position (leap-frog).

#include "particles/particle_set.hpp"

namespace sphdrop {

class FluidParticles : public ParticleSet {
 public:
  ScalarField mass{*this, "mass", "kg/m", Role::state | Role::constant | Role::written, "mass per metre of depth"};
  VectorField position{*this, "position", "m", Role::state | Role::ghosted | Role::written, "position", far_away};
  VectorField staggered_velocity{*this, "staggered_velocity", "m/s", Role::state, "velocity half a step back"};
  ScalarField staggered_density{*this, "staggered_density", "kg/m3", Role::state, "density half a step back"};
  VectorField acceleration{*this, "acceleration", "m/s2", Role::state, "total acceleration of the last step"};
  ScalarField density_rate{*this, "density_rate", "kg/m3/s", Role::state, "rate of density of the last step (9)"};
  ScalarField dissipated_energy{*this, "dissipated_energy", "J/m", Role::state, "heat made by viscosity so far"};
  ScalarField correction_energy{*this, "correction_energy", "J/m", Role::state,
                                "compressive energy added by the density's correction or diffusion so far"};
  ScalarField shift_energy{*this, "shift_energy", "J/m", Role::state,
                           "energy of compression and gravity added by shifts so far"};
  ScalarField gauge_energy{*this, "gauge_energy", "J/m", Role::state,
                           "energy of compression added by changes of the gauge pressure so far"};
  VectorField detection_position{*this, "detection_position", "m", Role::state,
                                 "position when the surface was last detected"};
  VectorField body_offset{*this, "body_offset", "m", Role::state,
                          "place in a rigid body: position from its mass centre at angle 0"};

  VectorField velocity{*this, "velocity", "m/s", Role::ghosted | Role::written, "velocity"};
  ScalarField density{*this, "density", "kg/m3", Role::ghosted | Role::written, "density", 1.0};
  ScalarField pressure{*this, "pressure", "Pa", Role::written, "pressure (4)"};
  ScalarField dissipation_rate{*this, "dissipation_rate", "W/kg", Role::derived, "specific heating by viscosity"};
  VectorField density_gradient{*this, "density_gradient", "kg/m4", Role::derived,
                               "gradient of density, where density diffuses"};
  ScalarField density_diffusion{*this, "density_diffusion", "kg/m3/s", Role::derived, "rate of density by diffusion"};
  TensorField surface_orientation{*this, "surface_orientation", "1", Role::derived,
                                  "mean n (x) n of the surface's normals within 2h, over its larger eigenvalue"};
  VectorField list_position{*this, "list_position", "m", Role::derived, "position when neighbours were last listed"};
};

}  // namespace sphdrop
