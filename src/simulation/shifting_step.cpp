#include "simulation/shifting_step.hpp"

#include "diagnostics/number_reader.hpp"

namespace sphdrop {

ShiftingStep::ShiftingStep(const Case& input, const SmoothingKernel& kernel)
    : is_enabled_(input.drop.is_liquid() && input.fluid.shifting == Switch::on),
      interval_(input.fluid.shifting_interval),
      parameters_{kernel, input.resolution.smoothing_ratio * input.resolution.spacing, input.resolution.spacing} {}

void ShiftingStep::find(const FluidParticles& fluid, const Distribution& distribution, double largest_speed,
                        double step) {
  x_.resize(fluid.size());
  y_.resize(fluid.size());
  concentration_gradients(fluid, distribution.inner_fluid(), parameters_, x_, y_);
  concentration_gradients(fluid, distribution.border_fluid(), parameters_, x_, y_);
  const double duration = static_cast<double>(interval_) * step;
  const TensorField& surface = fluid.surface_orientation;
  fluid.for_each_owned([&](std::size_t row) {
    const Vector displacement = shift({x_[row], y_[row]}, largest_speed, duration, parameters_, surface.xx[row],
                                      surface.xy[row], surface.yy[row]);
    x_[row] = displacement.x;
    y_[row] = displacement.y;
  });
  is_found_ = true;
}

void ShiftingStep::apply(FluidParticles& fluid) {
  if (!is_found_) return;
  is_found_ = false;
  fluid.for_each_owned([&](std::size_t row) {
    fluid.position.x[row] += x_[row];
    fluid.position.y[row] += y_[row];
  });
}

void ShiftingStep::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "shifting's work");
  work_ = reader.number();
  reader.expect_end();
}

}  // namespace sphdrop
