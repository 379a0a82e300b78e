#include "simulation/gauge_pressure_step.hpp"

#include <algorithm>
#include <array>

#include "diagnostics/number_reader.hpp"

namespace sphdrop {

GaugePressureStep::GaugePressureStep(const Communicator& communicator, const Case& input, const InitialFluid& initial)
    : is_enabled_(input.drop.is_liquid() && input.fluid.gauge_pressure == Switch::on),
      relaxation_time_(input.fluid.gauge_relaxation_time),
      lowest_(0.0 - input.fluid.ambient_pressure),
      rest_density_(input.fluid.density),
      inverse_squared_sound_speed_(1.0 / (input.fluid.sound_speed * input.fluid.sound_speed)),
      pressure_scale_(input.fluid.density * input.fluid.sound_speed * input.fluid.sound_speed),
      particle_count_(static_cast<double>(initial.total)),
      rest_area_(initial.rest_area),
      // Several times the drop's area fits, and the nodes' parts of it, which are not all of one sign.
      area_quantum_(QuantisedSum(0x1p-44 * std::max(rest_area_, 1e-30)).quantum()),
      pending_(communicator) {}

void GaugePressureStep::relax(FluidParticles& fluid, double step) {
  const double change = gauge_.relax(step, relaxation_time_);
  const double density_change = change * inverse_squared_sound_speed_;
  fluid.for_each_owned([&](std::size_t row) {
    const double middle = fluid.staggered_density[row] - 0.5 * density_change;
    fluid.staggered_density[row] -= density_change;
    fluid.gauge_energy[row] -= fluid.mass[row] * change * (middle - rest_density_) / (middle * middle);
  });
  adjustment_ -= change * (area_ - rest_area_);
}

void GaugePressureStep::start(const FluidParticles& fluid, const SurfaceTensionStep& surface) {
  PressureSums sums(pressure_scale_);
  fluid.for_each_owned([&](std::size_t row) { sums.add(fluid.pressure[row]); });
  const auto [first, low, high] = sums.words();
  QuantisedSum area(area_quantum_);
  surface.add_area(area);
  pending_.start(std::array{first, low, high, area.quanta()});
}

void GaugePressureStep::finish() {
  if (!pending_.is_under_way()) return;
  const std::span<const std::int64_t> words = pending_.finish();
  gauge_.target = PressureSums(pressure_scale_).target(words, particle_count_, lowest_);
  area_ = static_cast<double>(words[3]) * area_quantum_;
}

void GaugePressureStep::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "gauge pressure");
  gauge_.pressure = reader.number();
  gauge_.target = reader.number();
  area_ = reader.number();
  adjustment_ = reader.number();
  reader.expect_end();
}

}  // namespace sphdrop
