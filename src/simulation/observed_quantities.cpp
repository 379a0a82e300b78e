// The one table of watched quantities.

#include "simulation/observation.hpp"

namespace sphdrop {

std::span<const ObservedQuantity> observed_quantities() {
  using O = Observation;
  static constexpr ObservedQuantity table[] = {
      {"time", "s", "simulated time", &O::time},
      {"step", "1", "steps so far", &O::step},
      {"time_step", "s", "the step to come", &O::time_step},
      {"drop_width", "m", "D: max x - min x + d over the liquid", &O::drop_width},
      {"drop_height", "m", "max y - min y + d over the liquid", &O::drop_height},
      {"deflection", "m", "mean y displacement of the free end or of mid-span, negative downwards", &O::deflection},
      {"middle_deflection", "m", "mean y displacement of the beam's mid-span, negative downwards",
       &O::middle_deflection},
      {"tip_displacement_x", "m", "mean x displacement of a cantilever's free end", &O::tip_displacement_x},
      {"drop_centre_x", "m", "mass centre of the liquid", &O::drop_centre_x},
      {"drop_centre_y", "m", "mass centre of the liquid", &O::drop_centre_y},
      {"drop_velocity_x", "m/s", "velocity of the liquid's mass centre", &O::drop_velocity_x},
      {"drop_velocity_y", "m/s", "velocity of the liquid's mass centre", &O::drop_velocity_y},
      {"drop_angle", "rad", "angle by which a rigid drop has turned, counterclockwise", &O::drop_angle},
      {"drop_spin", "rad/s", "angular velocity of a rigid drop, counterclockwise", &O::drop_spin},
      {"drop_elongation", "m2", "mean of x^2 - y^2 over the liquid's mass, about its centre", &O::drop_elongation},
      {"quarter_centre_x", "m", "mass centre of the upper right quarter, from the drop's", &O::quarter_centre_x},
      {"quarter_centre_y", "m", "mass centre of the upper right quarter, from the drop's", &O::quarter_centre_y},
      {"mean_pressure", "Pa", "mean over the liquid's particles", &O::mean_pressure},
      {"gauge_pressure", "Pa", "reference that the liquid's pressures are counted from", &O::gauge_pressure},
      {"curve_length", "m", "length of the surface curves", &O::curve_length},
      {"curve_area", "m2", "area of the liquid within the surface curves", &O::curve_area},
      {"mean_curvature", "1/m", "mean over the surface curves, positive where convex", &O::mean_curvature},
      {"curvature_scatter", "1/m", "standard deviation of the curvature", &O::curvature_scatter},
      {"curve_count", "1", "closed surface curves of three nodes or more", &O::curve_count},
      {"tension_net_force", "1", "surface tension: |sum of forces| / sum of |forces|", &O::tension_net_force},
      {"base_width", "m", "B: width of the liquid's base on a solid that it wets", &O::base_width},
      {"contact_count", "1", "liquid particles in contact", &O::contact_count},
      {"contact_force_x", "N/m", "force on the solid", &O::contact_force_x},
      {"contact_force_y", "N/m", "force on the solid", &O::contact_force_y},
      {"contact_impulse_x", "N s/m", "impulse on the solid so far", &O::contact_impulse_x},
      {"contact_impulse_y", "N s/m", "impulse on the solid so far", &O::contact_impulse_y},
      {"contact_angular_impulse", "N m s/m", "angular impulse on the solid about the origin so far, counterclockwise",
       &O::contact_angular_impulse},
      {"kinetic_fluid", "J/m", "kinetic energy of the liquid", &O::kinetic_fluid},
      {"kinetic_solid", "J/m", "kinetic energy of the solid", &O::kinetic_solid},
      {"elastic", "J/m", "elastic energy of the solid", &O::elastic},
      {"compressive", "J/m", "energy of compression of the liquid", &O::compressive},
      {"surface", "J/m", "sigma times the length of the surface curves", &O::surface},
      {"adhesion", "J/m", "energy of the liquid's base on a solid that it wets: -sigma (1 + cos theta) times its width",
       &O::adhesion},
      {"contact", "J/m", "energy in the springs of the contact", &O::contact},
      {"gravity", "J/m", "potential energy in the field of gravity", &O::gravity},
      {"gauge", "J/m", "of the gauge pressure on the liquid's surface: -p_ref (area within the curves - mass/rho0)",
       &O::gauge},
      {"dissipated_fluid", "J/m", "heat made by the liquid's viscosity so far", &O::dissipated_fluid},
      {"dissipated_solid", "J/m", "heat made by the solid's viscosity and damping so far", &O::dissipated_solid},
      {"dissipated_contact", "J/m", "heat made by the contact's damping and the wall's drag so far",
       &O::dissipated_contact},
      {"density_correction", "J/m", "compressive energy added by the density's correction or diffusion so far",
       &O::density_correction},
      {"artificial_stress_work", "J/m", "work of the artificial stress so far", &O::artificial_stress_work},
      {"reconnection", "J/m", "energy of surface and gauge that came with detecting the surface's curves anew, so far",
       &O::reconnection},
      {"gauge_adjustment", "J/m",
       "energy of gauge and compression that came with changes of the gauge pressure, so far", &O::gauge_adjustment},
      {"shifting_work", "J/m",
       "energy of surface, adhesion, gauge, compression and gravity that shifts have added so far", &O::shifting_work},
      {"sharing_work", "J/m",
       "work of the forces of surface, adhesion and gauge on the particles that they are shared out over, less that on "
       "the surface's points, so far",
       &O::sharing_work},
      {"total", "J/m", "kinetic, elastic, compressive, surface, adhesion, contact, gravity and gauge", &O::total},
      {"unaccounted", "J/m",
       "total + dissipated - density correction - artificial stress - reconnection - gauge adjustment - shifting - "
       "sharing - total at the start",
       &O::unaccounted},
      {"momentum_fluid_x", "kg/s", "momentum of the liquid", &O::momentum_fluid_x},
      {"momentum_fluid_y", "kg/s", "momentum of the liquid", &O::momentum_fluid_y},
      {"momentum_solid_x", "kg/s", "momentum of the solid", &O::momentum_solid_x},
      {"momentum_solid_y", "kg/s", "momentum of the solid", &O::momentum_solid_y},
      {"angular_momentum_fluid", "kg m/s", "about the origin", &O::angular_momentum_fluid},
      {"angular_momentum_solid", "kg m/s", "about the origin", &O::angular_momentum_solid},
      {"largest_density_error", "1", "largest |rho/rho0 - 1| in the liquid", &O::largest_density_error},
  };
  static_assert(
      sizeof table / sizeof table[0] * sizeof(double) + sizeof(std::vector<SolidObservation>) == sizeof(Observation),
      "every quantity stands here");
  return table;
}

std::span<const SolidQuantity> solid_quantities() {
  using S = SolidObservation;
  static constexpr SolidQuantity table[] = {
      {"deflection", "m", "mean y displacement where it is watched, negative downwards", &S::deflection},
      {"displacement_x", "m", "mean x displacement there", &S::displacement_x},
      {"contact_force_x", "N/m", "force of the drops on it", &S::contact_force_x},
      {"contact_force_y", "N/m", "force of the drops on it", &S::contact_force_y},
  };
  static_assert(sizeof table / sizeof table[0] * sizeof(double) == sizeof(S), "every quantity stands here");
  return table;
}

}  // namespace sphdrop
