#include "simulation/gauge_pressure_step.hpp"

#include "diagnostics/number_reader.hpp"

namespace sphdrop {

GaugePressureStep::GaugePressureStep(const Communicator& communicator, const Case& input,
                                     std::span<const double> masses)
    : is_enabled_(input.drop.is_liquid() && input.fluid.gauge_pressure == Switch::on),
      relaxation_time_(input.fluid.gauge_relaxation_time),
      inverse_squared_sound_speed_(1.0 / (input.fluid.sound_speed * input.fluid.sound_speed)),
      pending_(communicator) {
  for (const double mass : masses) rest_area_ += mass / input.fluid.density;
}

void GaugePressureStep::relax(FluidParticles& fluid, double step) {
  const double change = gauge_.relax(step, relaxation_time_);
  const double density_change = change * inverse_squared_sound_speed_;
  fluid.for_each_owned([&](std::size_t row) { fluid.staggered_density[row] -= density_change; });
  adjustment_ -= change * (area_ - rest_area_);
}

void GaugePressureStep::start(const FluidParticles& fluid, double area) {
  sums_ = {};
  fluid.for_each_owned([&](std::size_t row) {
    const double p = fluid.pressure[row];
    sums_[0].add(p);
    sums_[1].add(p * p);
  });
  sums_[2].add(static_cast<double>(fluid.owned_count()));
  sums_[3].add(area);
  pending_.start(sums_);
}

void GaugePressureStep::finish() {
  if (!pending_.is_under_way()) return;
  pending_.finish(sums_);
  area_ = sums_[3].value();
  gauge_.target = gauge_target(sums_[0].value(), sums_[1].value(), sums_[2].value());
}

void GaugePressureStep::from_numbers(std::span<const double> numbers) {
  NumberReader reader(numbers, "gauge pressure");
  gauge_.pressure = reader.number();
  area_ = sums_[3].value();
  gauge_.target = reader.number();
  area_ = reader.number();
  adjustment_ = reader.number();
  reader.expect_end();
}

}  // namespace sphdrop
