#include "time_integration/leapfrog.hpp"

#include <algorithm>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

void advance_column(std::span<const RowRange> rows, double step, const Column<double>& rate, const Column<double>& from,
                    Column<double>& to) {
  for (const RowRange& range : rows) {
    const double* r = rate.data();
    const double* a = from.data();
    double* b = to.data();
    for (std::int32_t row = range.begin; row < range.end; ++row) b[row] = a[row] + step * r[row];
  }
}

void accumulate_energy(std::span<const RowRange> rows, double step, const ScalarField& mass, const ScalarField& power,
                       ScalarField& energy) {
  for (const RowRange& range : rows)
    for (std::int32_t k = range.begin; k < range.end; ++k) {
      const auto row = static_cast<std::size_t>(k);
      energy[row] += mass[row] * power[row] * step;
    }
}

// The largest squared value of a difference (or of a vector, without `origin`), by lanes: a maximum has no order.
class SquaredMaximum {
 public:
  void add(const Pack& x, const Pack& y, const Pack::mask_type& counted) {
    Pack square = x * x + y * y;
    where(!counted, square) = 0.0;
    largest_ = max(largest_, square);
    not_a_number_ = not_a_number_ || square != square;
  }
  double value() const { return hmax(largest_); }
  bool not_a_number() const { return any_of(not_a_number_); }

 private:
  Pack largest_{0.0};
  Pack::mask_type not_a_number_{false};
};

Pack::mask_type lanes_below(std::int32_t count) {
  return Pack([](auto lane) { return static_cast<double>(static_cast<int>(lane)); }) < static_cast<double>(count);
}

MotionMaxima finish(const SquaredMaximum& speed, const SquaredMaximum& moved, const SquaredMaximum& detected,
                    double speed_limit) {
  return {speed.value(), moved.value(), detected.value(),
          speed.not_a_number() || moved.not_a_number() || !(speed.value() <= speed_limit * speed_limit)};
}

}  // namespace

void predict(FluidParticles& f, double previous_step) {
  const double half = 0.5 * previous_step;
  advance_column(f.owned, half, f.acceleration.x, f.staggered_velocity.x, f.velocity.x);
  advance_column(f.owned, half, f.acceleration.y, f.staggered_velocity.y, f.velocity.y);
  advance_column(f.owned, half, f.density_rate.columns[0], f.staggered_density.columns[0], f.density.columns[0]);
}

void predict(SolidParticles& s, double previous_step) {
  const double half = 0.5 * previous_step;
  advance_column(s.owned, half, s.acceleration.x, s.staggered_velocity.x, s.velocity.x);
  advance_column(s.owned, half, s.acceleration.y, s.staggered_velocity.y, s.velocity.y);
  advance_column(s.owned, half, s.density_rate.columns[0], s.staggered_density.columns[0], s.density.columns[0]);
  for (std::size_t c = 0; c < 3; ++c)
    advance_column(s.owned, half, s.deviatoric_stress_rate.columns[c], s.staggered_deviatoric_stress.columns[c],
                   s.deviatoric_stress.columns[c]);
}

MotionMaxima kick_and_drift(FluidParticles& f, StepLengths steps, double speed_limit) {
  advance_column(f.owned, steps.kick(), f.acceleration.x, f.staggered_velocity.x, f.staggered_velocity.x);
  advance_column(f.owned, steps.kick(), f.acceleration.y, f.staggered_velocity.y, f.staggered_velocity.y);
  advance_column(f.owned, steps.kick(), f.density_rate.columns[0], f.staggered_density.columns[0],
                 f.staggered_density.columns[0]);
  advance_column(f.owned, steps.next, f.staggered_velocity.x, f.position.x, f.position.x);
  advance_column(f.owned, steps.next, f.staggered_velocity.y, f.position.y, f.position.y);
  accumulate_energy(f.owned, steps.next, f.mass, f.dissipation_rate, f.dissipated_energy);
  SquaredMaximum speed, moved, detected;
  for (const RowRange& range : f.owned) {
    for (std::int64_t row = range.begin; row < range.end; row += pack_size) {
      const auto counted = lanes_below(range.end - static_cast<std::int32_t>(row));
      const Pack x = load(f.position.x.data() + row), y = load(f.position.y.data() + row);
      speed.add(load(f.staggered_velocity.x.data() + row), load(f.staggered_velocity.y.data() + row), counted);
      moved.add(x - load(f.list_position.x.data() + row), y - load(f.list_position.y.data() + row), counted);
      detected.add(x - load(f.detection_position.x.data() + row), y - load(f.detection_position.y.data() + row),
                   counted);
    }
  }
  return finish(speed, moved, detected, speed_limit);
}

MotionMaxima kick_and_drift(SolidParticles& s, StepLengths steps, double speed_limit) {
  for (const RowRange& range : s.owned)
    for (std::int32_t row = range.begin; row < range.end; ++row) {
      const auto k = static_cast<std::size_t>(row);
      s.acceleration.x[k] *= s.mobility[k];
      s.acceleration.y[k] *= s.mobility[k];
    }
  advance_column(s.owned, steps.kick(), s.acceleration.x, s.staggered_velocity.x, s.staggered_velocity.x);
  advance_column(s.owned, steps.kick(), s.acceleration.y, s.staggered_velocity.y, s.staggered_velocity.y);
  advance_column(s.owned, steps.kick(), s.density_rate.columns[0], s.staggered_density.columns[0],
                 s.staggered_density.columns[0]);
  for (std::size_t c = 0; c < 3; ++c)
    advance_column(s.owned, steps.kick(), s.deviatoric_stress_rate.columns[c], s.staggered_deviatoric_stress.columns[c],
                   s.staggered_deviatoric_stress.columns[c]);
  advance_column(s.owned, steps.next, s.staggered_velocity.x, s.position.x, s.position.x);
  advance_column(s.owned, steps.next, s.staggered_velocity.y, s.position.y, s.position.y);
  SquaredMaximum speed, moved, none;
  accumulate_energy(s.owned, steps.next, s.mass, s.dissipation_rate, s.dissipated_energy);
  accumulate_energy(s.owned, steps.next, s.mass, s.artificial_stress_power, s.artificial_stress_work);
  for (const RowRange& range : s.owned) {
    for (std::int64_t row = range.begin; row < range.end; row += pack_size) {
      const auto counted = lanes_below(range.end - static_cast<std::int32_t>(row));
      speed.add(load(s.staggered_velocity.x.data() + row), load(s.staggered_velocity.y.data() + row), counted);
      moved.add(load(s.position.x.data() + row) - load(s.list_position.x.data() + row),
                load(s.position.y.data() + row) - load(s.list_position.y.data() + row), counted);
    }
  }
  return finish(speed, moved, none, speed_limit);
}

}  // namespace sphdrop
