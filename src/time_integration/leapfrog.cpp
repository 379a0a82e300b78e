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

// The largest squared length among the rows' vectors, or differences of vectors. A maximum has no order, so lanes and
// tail may be treated apart. No masks: clang 14 miscompiles those of std::experimental::simd for AVX-512.
class SquaredMaximum {
 public:
  void add(const Pack& x, const Pack& y) {
    const Pack square = x * x + y * y;
    largest_ = max(largest_, square);
    poison_ += square * Pack(0.0);  // not a number as soon as one square is infinite or none
  }
  void add(double x, double y) {
    const double square = x * x + y * y;
    tail_ = std::max(tail_, square);
    tail_poison_ += square * 0.0;
  }
  double value() const { return std::max(hmax(largest_), tail_); }
  bool is_sound() const {
    double sum = tail_poison_;
    for (std::size_t lane = 0; lane < Pack::size(); ++lane) sum += poison_[lane];
    return sum == 0.0;
  }

 private:
  Pack largest_{0.0}, poison_{0.0};
  double tail_ = 0.0, tail_poison_ = 0.0;
};

// The rectangle about vectors, in the same way.
class BoxMaximum {
 public:
  void add(const Pack& x, const Pack& y) {
    low_x_ = min(low_x_, x);
    high_x_ = max(high_x_, x);
    low_y_ = min(low_y_, y);
    high_y_ = max(high_y_, y);
  }
  void add(double x, double y) {
    tail_.low_x = std::min(tail_.low_x, x);
    tail_.high_x = std::max(tail_.high_x, x);
    tail_.low_y = std::min(tail_.low_y, y);
    tail_.high_y = std::max(tail_.high_y, y);
  }
  DisplacementBox value() const {
    return {std::min(hmin(low_x_), tail_.low_x), std::max(hmax(high_x_), tail_.high_x),
            std::min(hmin(low_y_), tail_.low_y), std::max(hmax(high_y_), tail_.high_y)};
  }

 private:
  DisplacementBox tail_;
  Pack low_x_{tail_.low_x}, high_x_{tail_.high_x}, low_y_{tail_.low_y}, high_y_{tail_.high_y};
};

/// |a|, or |a - b|, over the rows.
void add_rows(std::span<const RowRange> rows, const VectorField& a, SquaredMaximum& maximum) {
  for (const RowRange& range : rows) {
    std::int64_t row = range.begin;
    for (; row + pack_size <= range.end; row += pack_size) maximum.add(load(a.x.data() + row), load(a.y.data() + row));
    for (; row < range.end; ++row) maximum.add(a.x.data()[row], a.y.data()[row]);
  }
}
void add_rows(std::span<const RowRange> rows, const VectorField& a, const VectorField& b, SquaredMaximum& maximum) {
  for (const RowRange& range : rows) {
    std::int64_t row = range.begin;
    for (; row + pack_size <= range.end; row += pack_size)
      maximum.add(load(a.x.data() + row) - load(b.x.data() + row), load(a.y.data() + row) - load(b.y.data() + row));
    for (; row < range.end; ++row) maximum.add(a.x.data()[row] - b.x.data()[row], a.y.data()[row] - b.y.data()[row]);
  }
}

/// The box about a - b over the rows.
void add_rows(std::span<const RowRange> rows, const VectorField& a, const VectorField& b, BoxMaximum& box) {
  for (const RowRange& range : rows) {
    std::int64_t row = range.begin;
    for (; row + pack_size <= range.end; row += pack_size)
      box.add(load(a.x.data() + row) - load(b.x.data() + row), load(a.y.data() + row) - load(b.y.data() + row));
    for (; row < range.end; ++row) box.add(a.x.data()[row] - b.x.data()[row], a.y.data()[row] - b.y.data()[row]);
  }
}

MotionMaxima finish(const SquaredMaximum& speed, const SquaredMaximum& moved, const SquaredMaximum& detected,
                    double speed_limit) {
  return {speed.value(),
          moved.value(),
          detected.value(),
          {},
          {},
          !speed.is_sound() || !moved.is_sound() || !(speed.value() <= speed_limit * speed_limit)};
}

}  // namespace

void predict(FluidParticles& f, std::span<const RowRange> rows, double previous_step) {
  const double half = 0.5 * previous_step;
  advance_column(rows, half, f.acceleration.x, f.staggered_velocity.x, f.velocity.x);
  advance_column(rows, half, f.acceleration.y, f.staggered_velocity.y, f.velocity.y);
  advance_column(rows, half, f.density_rate.columns[0], f.staggered_density.columns[0], f.density.columns[0]);
}

void predict(FluidParticles& f, double previous_step) {
  predict(f, f.owned, previous_step);
}

void predict(SolidParticles& s, std::span<const RowRange> rows, double previous_step) {
  const double half = 0.5 * previous_step;
  advance_column(rows, half, s.acceleration.x, s.staggered_velocity.x, s.velocity.x);
  advance_column(rows, half, s.acceleration.y, s.staggered_velocity.y, s.velocity.y);
  advance_column(rows, half, s.density_rate.columns[0], s.staggered_density.columns[0], s.density.columns[0]);
  for (std::size_t c = 0; c < 3; ++c)
    advance_column(rows, half, s.deviatoric_stress_rate.columns[c], s.staggered_deviatoric_stress.columns[c],
                   s.deviatoric_stress.columns[c]);
}

void predict(SolidParticles& s, double previous_step) {
  predict(s, s.owned, previous_step);
}

void predict_velocity(SolidParticles& s, double previous_step) {
  const double half = 0.5 * previous_step;
  advance_column(s.owned, half, s.acceleration.x, s.staggered_velocity.x, s.velocity.x);
  advance_column(s.owned, half, s.acceleration.y, s.staggered_velocity.y, s.velocity.y);
}

namespace {

/// Motion of the liquid, run by run.
class FluidMotion {
 public:
  explicit FluidMotion(BoxesWanted boxes) : boxes_(boxes) {}

  void add(const FluidParticles& f, std::span<const RowRange> rows) {
    add_rows(rows, f.staggered_velocity, speed_);
    add_rows(rows, f.position, f.list_position, moved_);
    add_rows(rows, f.position, f.detection_position, detected_);
    if (boxes_.displacements) add_rows(rows, f.position, f.list_position, box_);
    if (boxes_.detection_displacements) add_rows(rows, f.position, f.detection_position, detection_box_);
  }
  MotionMaxima value(double speed_limit) const {
    MotionMaxima maxima = finish(speed_, moved_, detected_, speed_limit);
    if (boxes_.displacements) maxima.displacements = box_.value();
    if (boxes_.detection_displacements) maxima.detection_displacements = detection_box_.value();
    return maxima;
  }

 private:
  BoxesWanted boxes_;
  SquaredMaximum speed_, moved_, detected_;
  BoxMaximum box_, detection_box_;
};

}  // namespace

MotionMaxima motion_maxima(const FluidParticles& f, double speed_limit, BoxesWanted boxes) {
  FluidMotion motion(boxes);
  for_each_run(f.owned, [&](std::span<const RowRange> rows) { motion.add(f, rows); });
  return motion.value(speed_limit);
}

MotionMaxima kick_and_drift(FluidParticles& f, StepLengths steps, double speed_limit, BoxesWanted boxes) {
  FluidMotion motion(boxes);
  for_each_run(f.owned, [&](std::span<const RowRange> rows) {
    advance_column(rows, steps.kick(), f.acceleration.x, f.staggered_velocity.x, f.staggered_velocity.x);
    advance_column(rows, steps.kick(), f.acceleration.y, f.staggered_velocity.y, f.staggered_velocity.y);
    advance_column(rows, steps.kick(), f.density_rate.columns[0], f.staggered_density.columns[0],
                   f.staggered_density.columns[0]);
    advance_column(rows, steps.next, f.staggered_velocity.x, f.position.x, f.position.x);
    advance_column(rows, steps.next, f.staggered_velocity.y, f.position.y, f.position.y);
    accumulate_energy(rows, steps.next, f.mass, f.dissipation_rate, f.dissipated_energy);
    motion.add(f, rows);
  });
  return motion.value(speed_limit);
}

MotionMaxima kick_and_drift(SolidParticles& s, StepLengths steps, double speed_limit) {
  return kick_and_drift(s, steps, speed_limit, [](std::span<const RowRange>) {});
}

MotionMaxima kick_and_drift(SolidParticles& s, StepLengths steps, double speed_limit,
                            const std::function<void(std::span<const RowRange>)>& then) {
  SquaredMaximum speed, moved, none;
  for_each_run(s.owned, [&](std::span<const RowRange> rows) {
    for (const RowRange& range : rows)
      for (std::int32_t row = range.begin; row < range.end; ++row) {
        const auto k = static_cast<std::size_t>(row);
        s.acceleration.x[k] *= 1.0 - s.is_fixed[k];
        s.acceleration.y[k] *= 1.0 - s.is_fixed[k];
      }
    advance_column(rows, steps.kick(), s.acceleration.x, s.staggered_velocity.x, s.staggered_velocity.x);
    advance_column(rows, steps.kick(), s.acceleration.y, s.staggered_velocity.y, s.staggered_velocity.y);
    advance_column(rows, steps.kick(), s.density_rate.columns[0], s.staggered_density.columns[0],
                   s.staggered_density.columns[0]);
    for (std::size_t c = 0; c < 3; ++c)
      advance_column(rows, steps.kick(), s.deviatoric_stress_rate.columns[c], s.staggered_deviatoric_stress.columns[c],
                     s.staggered_deviatoric_stress.columns[c]);
    advance_column(rows, steps.next, s.staggered_velocity.x, s.position.x, s.position.x);
    advance_column(rows, steps.next, s.staggered_velocity.y, s.position.y, s.position.y);
    accumulate_energy(rows, steps.next, s.mass, s.dissipation_rate, s.dissipated_energy);
    accumulate_energy(rows, steps.next, s.mass, s.artificial_stress_power, s.artificial_stress_work);
    add_rows(rows, s.staggered_velocity, speed);
    add_rows(rows, s.position, s.list_position, moved);
    then(rows);
  });
  return finish(speed, moved, none, speed_limit);
}

MotionMaxima kick_and_drift_velocity(SolidParticles& s, StepLengths steps, double speed_limit, bool is_heated) {
  const double kick = steps.kick(), drift = steps.next;
  SquaredMaximum speed, moved, none;
  double *ax = s.acceleration.x.data(), *ay = s.acceleration.y.data();
  double *u = s.staggered_velocity.x.data(), *v = s.staggered_velocity.y.data();
  double *x = s.position.x.data(), *y = s.position.y.data();
  const double *is_fixed = s.is_fixed.data(), *x0 = s.list_position.x.data(), *y0 = s.list_position.y.data();
  for (const RowRange& range : s.owned) {
    std::int64_t row = range.begin;
    // One pass: these columns are read and written in every step, and little else is.
    for (; row + pack_size <= range.end; row += pack_size) {
      const Pack is_free = Pack(1.0) - load(is_fixed + row);
      const Pack a = load(ax + row) * is_free, b = load(ay + row) * is_free;
      const Pack new_u = load(u + row) + Pack(kick) * a, new_v = load(v + row) + Pack(kick) * b;
      const Pack new_x = load(x + row) + Pack(drift) * new_u, new_y = load(y + row) + Pack(drift) * new_v;
      store(a, ax + row);
      store(b, ay + row);
      store(new_u, u + row);
      store(new_v, v + row);
      store(new_x, x + row);
      store(new_y, y + row);
      speed.add(new_u, new_v);
      moved.add(new_x - load(x0 + row), new_y - load(y0 + row));
    }
    for (; row < range.end; ++row) {
      const double is_free = 1.0 - is_fixed[row];
      ax[row] *= is_free;
      ay[row] *= is_free;
      u[row] += kick * ax[row];
      v[row] += kick * ay[row];
      x[row] += drift * u[row];
      y[row] += drift * v[row];
      speed.add(u[row], v[row]);
      moved.add(x[row] - x0[row], y[row] - y0[row]);
    }
  }
  if (is_heated) accumulate_energy(s.owned, steps.next, s.mass, s.dissipation_rate, s.dissipated_energy);
  return finish(speed, moved, none, speed_limit);
}

}  // namespace sphdrop
