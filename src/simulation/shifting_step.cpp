#include "simulation/shifting_step.hpp"

#include "diagnostics/energy.hpp"
#include "diagnostics/number_reader.hpp"

namespace sphdrop {

ShiftingStep::ShiftingStep(const Communicator& communicator, const Case& input, const SmoothingKernel& kernel)
    : is_enabled_(input.drop.is_liquid() && input.fluid.shifting == Switch::on),
      interval_(input.fluid.shifting_interval),
      rest_density_(input.fluid.density),
      sound_speed_(input.fluid.sound_speed),
      parameters_{kernel, input.resolution.smoothing_ratio * input.resolution.spacing, input.resolution.spacing},
      work_(communicator, surface_energy_quantum(input.surface_tension.coefficient, input.resolution.spacing)) {}

void ShiftingStep::find(const FluidParticles& fluid, const Distribution& distribution, const ContactStep& contact,
                        double largest_speed, double step) {
  for (auto* column : {&x_, &y_, &concentration_, &returned_}) column->resize(fluid.size());
  concentration_gradients(fluid, distribution.inner_fluid(), parameters_, x_, y_, concentration_);
  concentration_gradients(fluid, distribution.border_fluid(), parameters_, x_, y_, concentration_);
  const double duration = static_cast<double>(interval_) * step;
  const TensorField& surface = fluid.surface_orientation;
  for (auto* column : {&contact_x_, &contact_y_}) column->assign(fluid.size(), 0.0);
  for (std::size_t k = 0; k < contact.fluid_rows().size(); ++k) {
    const auto row = static_cast<std::size_t>(contact.fluid_rows()[k]);
    contact_x_[row] = contact.acceleration_x()[k];
    contact_y_[row] = contact.acceleration_y()[k];
  }
  fluid.for_each_owned([&](std::size_t row) {
    Vector displacement = shift({x_[row], y_[row]}, largest_speed, duration, parameters_, surface.xx[row],
                                surface.xy[row], surface.yy[row]);
    displacement = without_component(displacement, {contact_x_[row], contact_y_[row]});
    x_[row] = displacement.x;
    y_[row] = displacement.y;
    // Near the surface the sums lack neighbours.
    const bool is_within = surface.xx[row] == 0.0 && surface.yy[row] == 0.0;
    returned_[row] =
        is_within ? rest_density_ * returned_density(concentration_[row], largest_speed, duration, parameters_) : 0.0;
  });
  is_found_ = true;
}

void ShiftingStep::apply(FluidParticles& fluid, Vector gravity, double kick) {
  if (!is_found_) return;
  is_found_ = false;
  fluid.for_each_owned([&](std::size_t row) {
    fluid.position.x[row] += x_[row];
    fluid.position.y[row] += y_[row];
    fluid.staggered_density[row] += returned_[row];
    // The pressures of this instant, which do not know it yet, act through the whole kick; what is returned is there at
    // its end.
    const double density = fluid.staggered_density[row] + kick * fluid.density_rate[row];
    const double compression = compressive_energy_per_mass(density, rest_density_, sound_speed_) -
                               compressive_energy_per_mass(density - returned_[row], rest_density_, sound_speed_);
    fluid.shift_energy[row] += fluid.mass[row] * (compression - dot(gravity, {x_[row], y_[row]}));
  });
}

void ShiftingStep::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "shifting's work");
  work_.restore(reader.number());
  reader.expect_end();
}

}  // namespace sphdrop
