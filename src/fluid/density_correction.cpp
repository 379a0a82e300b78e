#include "fluid/density_correction.hpp"

#include "particles/pack.hpp"

namespace sphdrop {

double moving_least_squares_density(const MovingLeastSquaresSums<double>& s, double own_density, bool has_neighbours) {
  if (!has_neighbours) return own_density;
  // First column of the inverse of A: cofactors over the determinant.
  const double c0 = s.axx * s.ayy - s.axy * s.axy;
  const double cx = s.axy * s.a0y - s.a0x * s.ayy;
  const double cy = s.a0x * s.axy - s.axx * s.a0y;
  const double determinant = s.a00 * c0 + s.a0x * cx + s.a0y * cy;
  if (!(determinant >= 1e-3 * (s.a00 * s.a00 * s.a00))) return s.m0 / s.a00;
  return (c0 * s.m0 + cx * s.mx + cy * s.my) / determinant;
}

namespace {

template <class Kernel>
void densities_with(const Kernel& kernel, const FluidParticles& fluid, const SlicedNeighbours& list, double spacing,
                    std::vector<double>& corrected) {
  const Pack inverse_spacing(1.0 / spacing);
  const Pack own_value(kernel.value(0.0));
  const double* x = fluid.position.x.data();
  const double* y = fluid.position.y.data();
  const double* density = fluid.density.data();
  const double* mass = fluid.mass.data();
  for (const SlicedNeighbours::Slice& slice : list.slices) {
    for (std::int32_t first = 0; first < slice.rows; first += pack_size) {
      const std::int64_t row = slice.first_row + first;
      const Pack xi = load(x + row), yi = load(y + row), own_mass = load(mass + row);
      MovingLeastSquaresSums<Pack> sums;
      sums.add(Pack(0.0), Pack(0.0), own_value, own_mass, own_mass / load(density + row));
      const std::int32_t* neighbours = list.neighbours.data() + std::int64_t{slice.first_entry} * block_size + first;
      Pack nearest(far_away);
      for (std::int32_t entry = 0; entry < slice.entries; ++entry, neighbours += block_size) {
        const auto gather = [&](const double* column) {
          return Pack([&](auto lane) { return column[neighbours[lane]]; });
        };
        const Pack dx = xi - gather(x), dy = yi - gather(y);
        const Pack distance = sqrt(dx * dx + dy * dy);
        const Pack neighbour_mass = gather(mass);
        sums.add(dx * inverse_spacing, dy * inverse_spacing, kernel.value(distance), neighbour_mass,
                 neighbour_mass / gather(density));
        nearest = min(nearest, distance);
      }
      for (std::int32_t k = 0; k < pack_size && first + k < slice.rows; ++k) {
        const auto lane = static_cast<std::size_t>(k);
        const MovingLeastSquaresSums<double> mine{sums.a00[lane], sums.a0x[lane], sums.a0y[lane],
                                                  sums.axx[lane], sums.axy[lane], sums.ayy[lane],
                                                  sums.m0[lane],  sums.mx[lane],  sums.my[lane]};
        const bool has_neighbours = nearest[lane] * kernel.inverse_smoothing_length < 2.0;
        const auto own = static_cast<std::size_t>(row + k);
        corrected[own] = moving_least_squares_density(mine, density[own], has_neighbours);
      }
    }
  }
}

}  // namespace

void moving_least_squares_densities(const FluidParticles& fluid, const SlicedNeighbours& list,
                                    const SmoothingKernel& kernel, double spacing, std::vector<double>& corrected) {
  std::visit([&](const auto& chosen) { densities_with(chosen, fluid, list, spacing, corrected); }, kernel);
}

}  // namespace sphdrop
