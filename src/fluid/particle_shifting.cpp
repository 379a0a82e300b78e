#include "fluid/particle_shifting.hpp"

#include <cmath>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

constexpr double rate = 2.0;            // -2 h v_max: Sun et al. 2017
constexpr double largest_shift = 0.05;  // in spacings
constexpr double repulsion = 0.2;       // of what is too near; its exponent is 4

template <class Kernel>
void gradients_with(const Kernel& kernel, double spacing, const FluidParticles& fluid, const SlicedNeighbours& list,
                    double* gradient_x, double* gradient_y) {
  const double *x = fluid.position.x.data(), *y = fluid.position.y.data();
  const Pack inverse_value(1.0 / kernel.value(spacing)), volume(spacing * spacing);
  for (const SlicedNeighbours::Slice& slice : list.slices)
    for (std::int32_t first = 0; first < slice.rows; first += pack_size) {
      const std::int64_t row = slice.first_row + first;
      const Pack xi = load(x + row), yi = load(y + row);
      Pack sum_x(0.0), sum_y(0.0);
      const std::int32_t* neighbours = list.neighbours.data() + std::int64_t{slice.first_entry} * block_size + first;
      for (std::int32_t entry = 0; entry < slice.entries; ++entry, neighbours += block_size) {
        const Pack dx = xi - Pack([&](auto lane) { return x[neighbours[lane]]; });
        const Pack dy = yi - Pack([&](auto lane) { return y[neighbours[lane]]; });
        const Pack distance = sqrt(max(dx * dx + dy * dy, Pack(1e-60)));
        const Pack nearness = kernel.value(distance) * inverse_value, square = nearness * nearness;
        const Pack weight = (Pack(1.0) + Pack(repulsion) * (square * square)) * (kernel.slope(distance) / distance);
        sum_x += weight * dx;
        sum_y += weight * dy;
      }
      sum_x *= volume;
      sum_y *= volume;
      for (std::int32_t k = 0; k < pack_size && first + k < slice.rows; ++k) {
        gradient_x[row + k] = sum_x[static_cast<std::size_t>(k)];
        gradient_y[row + k] = sum_y[static_cast<std::size_t>(k)];
      }
    }
}

}  // namespace

void concentration_gradients(const FluidParticles& fluid, const SlicedNeighbours& list,
                             const ShiftingParameters& parameters, std::vector<double>& x, std::vector<double>& y) {
  std::visit([&](const auto& kernel) { gradients_with(kernel, parameters.spacing, fluid, list, x.data(), y.data()); },
             parameters.kernel);
}

Vector shift(Vector gradient, double largest_speed, double duration, const ShiftingParameters& parameters,
             double surface_xx, double surface_xy, double surface_yy) {
  Vector displacement = -(rate * parameters.smoothing_length * largest_speed * duration) * gradient;
  const double limit = largest_shift * parameters.spacing, squared = squared_length(displacement);
  if (squared > limit * limit) displacement = (limit / std::sqrt(squared)) * displacement;
  return {displacement.x - (surface_xx * displacement.x + surface_xy * displacement.y),
          displacement.y - (surface_xy * displacement.x + surface_yy * displacement.y)};
}

OrientationSums normalised(const OrientationSums& m) {
  const double mean = 0.5 * (m.xx + m.yy), half = 0.5 * (m.xx - m.yy);
  const double larger = mean + std::sqrt(half * half + m.xy * m.xy);
  if (!(larger > 0.0)) return {};
  return {m.xx / larger, m.xy / larger, m.yy / larger};
}

}  // namespace sphdrop
