#include "simulation/derived_parameters.hpp"

#include <algorithm>

#include "diagnostics/theory.hpp"

namespace sphdrop {

namespace {

SmoothingKernel smoothing_kernel(KernelShape shape, double smoothing_length) {
  if (shape == KernelShape::wendland_c2) return WendlandC2(smoothing_length);
  return CubicSpline(smoothing_length);
}

AnyFluidPairParameters fluid_pair_parameters(const Case::Fluid& fluid, const SmoothingKernel& kernel,
                                             double smoothing_length) {
  return std::visit(
      [&](const auto& chosen) -> AnyFluidPairParameters {
        using Kernel = std::decay_t<decltype(chosen)>;
        if (fluid.viscosity_form == ViscosityForm::physical)
          return FluidPairParameters<Kernel, PhysicalViscosity>{chosen, {fluid.viscosity, smoothing_length}};
        return FluidPairParameters<Kernel, ArtificialViscosity>{
            chosen,
            {fluid.artificial_viscosity_alpha, fluid.artificial_viscosity_beta, fluid.sound_speed, smoothing_length}};
      },
      kernel);
}

double mass_proportional_damping_rate(const Case::Solid& solid) {
  if (!solid.is_straight_beam() || !(solid.damping_ratio > 0)) return solid.damping_rate;
  const BeamProperties beam{solid.youngs_modulus, solid.poisson_ratio, solid.density, solid.length, solid.thickness};
  return solid.damping_rate + 2.0 * solid.damping_ratio *
                                  (solid.kind == SolidKind::cantilever ? cantilever_angular_frequency(beam)
                                                                       : fixed_fixed_angular_frequency(beam));
}

}  // namespace

DerivedParameters::DerivedParameters(const Case& c)
    : smoothing_length(c.resolution.smoothing_ratio * c.resolution.spacing),
      kernel(smoothing_kernel(c.resolution.kernel, smoothing_length)),
      range{2.0 * smoothing_length, c.parallel.skin * c.resolution.spacing},
      fluid_pair(fluid_pair_parameters(c.fluid, kernel, smoothing_length)),
      solid{{CubicSpline(smoothing_length), {}, 1.0 / CubicSpline(smoothing_length).value(c.resolution.spacing)},
            {c.first_elastic_solid().density, c.first_elastic_solid().youngs_modulus,
             c.first_elastic_solid().poisson_ratio},
            c.first_elastic_solid().deviatoric_trace == DeviatoricTrace::plane_strain ? 1.0 / 3.0 : 0.5,
            c.first_elastic_solid().artificial_stress_coefficient} {
  const bool is_elastic = c.has_elastic_solid();
  const Case::Solid& first = c.first_elastic_solid();
  const bool has_drop = c.drop.shape != DropShape::none;
  solid.pair.viscosity = {first.artificial_viscosity_alpha, first.artificial_viscosity_beta,
                          solid.material.sound_speed(), smoothing_length};
  double solid_speed = 0, viscous_time = 0;
  for (std::size_t k = 0; k < c.solid_count(); ++k) {
    const Case::Solid& one = c.solid_at(k);
    damping_rate.push_back(one.is_elastic() ? mass_proportional_damping_rate(one) : 0.0);
    if (!one.is_elastic()) continue;
    solid_speed =
        std::max(solid_speed, ElasticMaterial{one.density, one.youngs_modulus, one.poisson_ratio}.sound_speed());
    viscous_time = std::max(viscous_time, one.viscous_time);
  }
  time_step.sound_cfl = c.time.sound_cfl;
  time_step.capillary_cfl = c.time.capillary_cfl;
  time_step.viscous_cfl = c.time.viscous_cfl;
  time_step.smoothing_length = smoothing_length;
  // No sound runs through a rigid drop; where none runs through the solid either, the liquid's sets the step, and with
  // it the contact's stiffness (Eq 24).
  const bool heeds_fluid_speed = c.drop.is_liquid() || (has_drop && !is_elastic);
  time_step.sound_speed = std::max(heeds_fluid_speed ? c.fluid.sound_speed : 0.0, is_elastic ? solid_speed : 0.0);
  if (c.time.solid_substeps > 1) {
    time_step.sound_speed = solid_speed;
    time_step.solid_substeps = static_cast<double>(c.time.solid_substeps);
    time_step.liquid_sound_cfl = c.time.liquid_sound_cfl;
    time_step.liquid_sound_speed = c.fluid.sound_speed;
  }
  time_step.density = c.fluid.density;
  const bool has_tension = c.drop.is_liquid() && c.surface_tension.form != SurfaceTensionForm::none;
  time_step.surface_tension = has_tension ? c.surface_tension.coefficient : 0.0;
  time_step.viscosity = c.drop.is_liquid() ? c.fluid.viscosity : 0.0;
  time_step.viscous_time = viscous_time;
}

}  // namespace sphdrop
