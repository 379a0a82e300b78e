#include "fluid/density_diffusion.hpp"

#include <algorithm>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

/// A slice's rows, a pack of them at a time.
struct Lanes {
  std::int64_t row;                ///< of the first lane
  std::int32_t used;               ///< lanes that hold a row of the slice
  const std::int32_t* neighbours;  ///< of the first entry
  std::int32_t entries;

  /// A column's values at the neighbours of one entry.
  [[gnu::always_inline]] Pack gather(const double* column, std::int32_t entry) const {
    const std::int32_t* rows = neighbours + std::ptrdiff_t{entry} * block_size;
    return Pack([&](auto lane) { return column[rows[lane]]; });
  }
};

template <class F>
[[gnu::always_inline]] inline void for_each_pack(const SlicedNeighbours& list, F&& f) {
  for (const SlicedNeighbours::Slice& slice : list.slices)
    for (std::int32_t first = 0; first < slice.rows; first += pack_size)
      f(Lanes{slice.first_row + first, std::min(pack_size, slice.rows - first),
              list.neighbours.data() + std::int64_t{slice.first_entry} * block_size + first, slice.entries});
}

// Keeps grad W finite, and zero, where two particles coincide or a particle is its own padding.
[[gnu::always_inline]] inline Pack distance_of(const Pack& dx, const Pack& dy) {
  return sqrt(max(dx * dx + dy * dy, Pack(1e-60)));
}

template <class Kernel>
void gradients_with(const Kernel& kernel, FluidParticles& fluid, const SlicedNeighbours& list) {
  const double *x = fluid.position.x.data(), *y = fluid.position.y.data();
  const double *density = fluid.density.data(), *mass = fluid.mass.data();
  for_each_pack(list, [&](const Lanes& lanes) {
    const Pack xi = load(x + lanes.row), yi = load(y + lanes.row), density_i = load(density + lanes.row);
    DensityGradientSums<Pack> sums;
    for (std::int32_t entry = 0; entry < lanes.entries; ++entry) {
      const Pack dx = xi - lanes.gather(x, entry), dy = yi - lanes.gather(y, entry);
      const Pack distance = distance_of(dx, dy);
      const Pack density_j = lanes.gather(density, entry);
      const InversePair<Pack> inverse(distance, density_j);
      sums.add(dx, dy, kernel.slope(distance) * inverse.first, lanes.gather(mass, entry) * inverse.second,
               density_j - density_i);
    }
    for (std::int32_t k = 0; k < lanes.used; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      fluid.density_gradient.set(static_cast<std::size_t>(lanes.row + k),
                                 renormalised_density_gradient({sums.moment_xx[lane], sums.moment_xy[lane],
                                                                sums.moment_yy[lane], sums.x[lane], sums.y[lane]}));
    }
  });
}

template <class Kernel>
void diffusion_with(const Kernel& kernel, FluidParticles& fluid, const SlicedNeighbours& list, double coefficient) {
  const double *x = fluid.position.x.data(), *y = fluid.position.y.data();
  const double *gradient_x = fluid.density_gradient.x.data(), *gradient_y = fluid.density_gradient.y.data();
  const double *density = fluid.density.data(), *mass = fluid.mass.data();
  for_each_pack(list, [&](const Lanes& lanes) {
    const Pack xi = load(x + lanes.row), yi = load(y + lanes.row), density_i = load(density + lanes.row);
    const Pack gradient_xi = load(gradient_x + lanes.row), gradient_yi = load(gradient_y + lanes.row);
    Pack sum(0.0);
    for (std::int32_t entry = 0; entry < lanes.entries; ++entry) {
      const Pack dx = xi - lanes.gather(x, entry), dy = yi - lanes.gather(y, entry);
      const Pack distance = distance_of(dx, dy);
      const Pack density_j = lanes.gather(density, entry);
      const InversePair<Pack> inverse(distance, density_j);
      const Pack volume_slope = lanes.gather(mass, entry) * inverse.second * (kernel.slope(distance) * inverse.first);
      const Pack along =
          (gradient_xi + lanes.gather(gradient_x, entry)) * dx + (gradient_yi + lanes.gather(gradient_y, entry)) * dy;
      sum += volume_slope * (Pack(2.0) * (density_i - density_j) - along);
    }
    const Pack rate = Pack(coefficient) * sum;
    for (std::int32_t k = 0; k < lanes.used; ++k) {
      const auto row = static_cast<std::size_t>(lanes.row + k);
      fluid.density_diffusion[row] = rate[static_cast<std::size_t>(k)];
      fluid.density_rate[row] += fluid.density_diffusion[row];
    }
  });
}

}  // namespace

Vector renormalised_density_gradient(const DensityGradientSums<double>& s) {
  const double determinant = s.moment_xx * s.moment_yy - s.moment_xy * s.moment_xy;
  const double mean = 0.5 * (s.moment_xx + s.moment_yy);
  if (!(determinant >= 1e-3 * (mean * mean)) || mean == 0.0) return {};
  return {(s.moment_yy * s.x - s.moment_xy * s.y) / determinant, (s.moment_xx * s.y - s.moment_xy * s.x) / determinant};
}

void density_gradients(FluidParticles& fluid, const SlicedNeighbours& list, const SmoothingKernel& kernel) {
  std::visit([&](const auto& chosen) { gradients_with(chosen, fluid, list); }, kernel);
}

void add_density_diffusion(FluidParticles& fluid, const SlicedNeighbours& list, const SmoothingKernel& kernel,
                           double coefficient) {
  std::visit([&](const auto& chosen) { diffusion_with(chosen, fluid, list, coefficient); }, kernel);
}

}  // namespace sphdrop
