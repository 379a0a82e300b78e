#include "fluid/particle_shifting.hpp"

#include <algorithm>
#include <cmath>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

constexpr double rate = 2.0;            // -2 h v_max: Sun et al. 2017
constexpr double largest_shift = 0.05;  // in spacings
constexpr double near_enough = 3.0;     // (W/W(d))^4 at 0.8 d: what is farther is no clump
constexpr double full_crowding = 0.05;  // C - 1 from which on a crowd spreads without restraint
constexpr double tolerance = 0.02;      // of C, which scatters by so much in a sound liquid
constexpr double largest_excess = 0.05;
constexpr double return_length = 10.0;  // in h, that the fastest particle covers while the volume comes back

template <class Kernel>
void gradients_with(const Kernel& kernel, double spacing, const FluidParticles& fluid, const SlicedNeighbours& list,
                    double* gradient_x, double* gradient_y, double* concentration) {
  const double *x = fluid.position.x.data(), *y = fluid.position.y.data();
  const Pack inverse_value(1.0 / kernel.value(spacing)), volume(spacing * spacing);
  for (const SlicedNeighbours::Slice& slice : list.slices)
    for (std::int32_t first = 0; first < slice.rows; first += pack_size) {
      const std::int64_t row = slice.first_row + first;
      const Pack xi = load(x + row), yi = load(y + row);
      Pack sum_x(0.0), sum_y(0.0), near_x(0.0), near_y(0.0), sum(kernel.value(0.0));
      const std::int32_t* neighbours = list.neighbours.data() + std::int64_t{slice.first_entry} * block_size + first;
      for (std::int32_t entry = 0; entry < slice.entries; ++entry, neighbours += block_size) {
        const Pack dx = xi - Pack([&](auto lane) { return x[neighbours[lane]]; });
        const Pack dy = yi - Pack([&](auto lane) { return y[neighbours[lane]]; });
        const Pack distance = sqrt(max(dx * dx + dy * dy, Pack(1e-60)));
        const Pack value = kernel.value(distance), nearness = value * inverse_value, square = nearness * nearness;
        const Pack slope = kernel.slope(distance) / distance;
        const Pack clump = max(Pack(0.0), square * square - Pack(near_enough)) * slope;
        sum += value;
        sum_x += slope * dx;
        sum_y += slope * dy;
        near_x += clump * dx;
        near_y += clump * dy;
      }
      sum *= volume;
      const Pack crowding = min(Pack(1.0), max(Pack(0.0), (sum - Pack(1.0)) * Pack(1.0 / full_crowding)));
      sum_x = (crowding * sum_x + near_x) * volume;
      sum_y = (crowding * sum_y + near_y) * volume;
      for (std::int32_t k = 0; k < pack_size && first + k < slice.rows; ++k) {
        gradient_x[row + k] = sum_x[static_cast<std::size_t>(k)];
        gradient_y[row + k] = sum_y[static_cast<std::size_t>(k)];
        concentration[row + k] = sum[static_cast<std::size_t>(k)];
      }
    }
}

}  // namespace

void concentration_gradients(const FluidParticles& fluid, const SlicedNeighbours& list,
                             const ShiftingParameters& parameters, std::vector<double>& x, std::vector<double>& y,
                             std::vector<double>& concentration) {
  std::visit(
      [&](const auto& kernel) {
        gradients_with(kernel, parameters.spacing, fluid, list, x.data(), y.data(), concentration.data());
      },
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

double returned_density(double concentration, double largest_speed, double duration,
                        const ShiftingParameters& parameters) {
  const double error = concentration - 1.0;
  const double excess = std::max(0.0, error - tolerance) + std::min(0.0, error + tolerance);
  const double share = largest_speed * duration / (return_length * parameters.smoothing_length);
  return std::max(-largest_excess, std::min(largest_excess, excess)) * std::min(1.0, share);
}

OrientationSums normalised(const OrientationSums& m) {
  const double mean = 0.5 * (m.xx + m.yy), half = 0.5 * (m.xx - m.yy);
  const double larger = mean + std::sqrt(half * half + m.xy * m.xy);
  if (!(larger > 0.0)) return {};
  return {m.xx / larger, m.xy / larger, m.yy / larger};
}

}  // namespace sphdrop
