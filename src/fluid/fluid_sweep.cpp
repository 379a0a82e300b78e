#include "fluid/fluid_sweep.hpp"

#include <type_traits>

#include "particles/pack.hpp"

namespace sphdrop {

namespace {

// What the steps of three pairs hold needs the 32 registers that come with vectors of eight.
constexpr bool steps_side_by_side = pack_size == 8;

// Rows past the end that a list may name as its padding, or that the last slice covers.
constexpr std::size_t padding_records = block_size;

[[gnu::always_inline]] inline FluidState<Pack> load_state(const double* records, const std::int32_t* rows) {
  const auto r = load_records(records, rows);
  return {r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7]};
}

void write_record(double* record, const FluidParticles& fluid, std::size_t row, double gauge_pressure) {
  record[0] = fluid.position.x[row];
  record[1] = fluid.position.y[row];
  record[2] = fluid.velocity.x[row];
  record[3] = fluid.velocity.y[row];
  record[4] = fluid.density[row];
  record[5] = fluid.pressure[row] - gauge_pressure;
  record[6] = fluid.mass[row];
  record[7] = fluid.mass[row] / fluid.density[row];
}

template <class Parameters>
void sweep(const Parameters& shared_parameters, const double* records, FluidParticles& fluid,
           const SlicedNeighbours& list) {
  const Parameters parameters = shared_parameters;
  for (const SlicedNeighbours::Slice& slice : list.slices) {
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size) {
      std::int32_t own_rows[block_size];
      for (std::int32_t k = 0; k < pack_size; ++k) own_rows[k] = slice.first_row + lane + k;
      const FluidState<Pack> i = load_state(records, own_rows);
      const Pack inverse_density = Pack(1.0) / i.density;
      FluidRates<Pack> rates;
      const std::int32_t* neighbour_rows = list.neighbours.data() + std::int64_t{slice.first_entry} * block_size + lane;
      const auto separate = [&](const FluidState<Pack>& j) __attribute__((always_inline)) {
        return Separation<Pack>(i.x - j.x, i.y - j.y);
      };
      const auto invert = [&](const Separation<Pack>& separation, const FluidState<Pack>& j)
          __attribute__((always_inline)) {
        return InverseSeparation<Pack>(separation, parameters.viscosity, i.density, j.density);
      };
      if (steps_side_by_side && slice.entries > 1) {
        FluidState<Pack> next = load_state(records, neighbour_rows);
        InverseSeparation<Pack> next_inverse = invert(separate(next), next);
        neighbour_rows += block_size;
        FluidState<Pack> after_next = load_state(records, neighbour_rows);
        Separation<Pack> after_next_separation = separate(after_next);
        for (std::int32_t entry = 2; entry < slice.entries; ++entry) {
          const FluidState<Pack> j = next;
          const InverseSeparation<Pack> inverse = next_inverse;
          next = after_next;
          next_inverse = invert(after_next_separation, next);
          neighbour_rows += block_size;
          after_next = load_state(records, neighbour_rows);
          after_next_separation = separate(after_next);
          add_fluid_pair(parameters, inverse, i, inverse_density, j, rates);
        }
        add_fluid_pair(parameters, next_inverse, i, inverse_density, next, rates);
        add_fluid_pair(parameters, invert(after_next_separation, after_next), i, inverse_density, after_next, rates);
      } else {
        for (std::int32_t entry = 0; entry < slice.entries; ++entry, neighbour_rows += block_size)
          add_fluid_pair(parameters, i, inverse_density, load_state(records, neighbour_rows), rates);
      }
      const std::int64_t row = slice.first_row + lane;
      store(rates.density_rate, fluid.density_rate.data() + row);
      store(rates.acceleration_x, fluid.acceleration.x.data() + row);
      store(rates.acceleration_y, fluid.acceleration.y.data() + row);
      store(rates.dissipation_rate, fluid.dissipation_rate.data() + row);
    }
  }
}

}  // namespace

void FluidSweep::resize(const FluidParticles& fluid) {
  records_.resize((fluid.size() + padding_records) * 8);
  for (std::size_t row = fluid.size(); row < fluid.size() + padding_records; ++row)
    write_record(records_.data() + 8 * row, fluid, row, 0.0);
}

void FluidSweep::pack(const FluidParticles& fluid, std::span<const RowRange> rows, double gauge_pressure) {
  for (const RowRange& range : rows)
    for (std::int32_t row = range.begin; row < range.end; ++row)
      write_record(records_.data() + 8 * std::int64_t{row}, fluid, static_cast<std::size_t>(row), gauge_pressure);
}

void FluidSweep::apply(FluidParticles& fluid, const SlicedNeighbours& list) const {
  std::visit(
      [&]<class Kernel, class Viscosity>(const FluidPairParameters<Kernel, Viscosity>& parameters) {
        if constexpr (std::is_same_v<Viscosity, ArtificialViscosity>)
          if (parameters.viscosity.beta == 0.0)
            return sweep(
                FluidPairParameters<Kernel, LinearArtificialViscosity>{parameters.kernel,
                                                                       LinearArtificialViscosity(parameters.viscosity)},
                records_.data(), fluid, list);
        sweep(parameters, records_.data(), fluid, list);
      },
      parameters_);
}

}  // namespace sphdrop
