#include "solid/hypoelastic/hypoelastic_sweep.hpp"

#include "particles/pack.hpp"
#include "solid/hypoelastic/artificial_stress.hpp"
#include "solid/hypoelastic/shared_interactions.hpp"
#include "sph/equation_of_state.hpp"

namespace sphdrop {

namespace {

// Of the columns that a loop over pairs reads, so that their addresses stay in registers.
struct Columns {
  explicit Columns(const SolidParticles& s)
      : x(s.position.x.data()),
        y(s.position.y.data()),
        velocity_x(s.velocity.x.data()),
        velocity_y(s.velocity.y.data()),
        density(s.density.data()),
        mass(s.mass.data()),
        volume(s.volume.data()),
        stress_xx(s.stress.xx.data()),
        stress_yy(s.stress.yy.data()),
        stress_xy(s.stress.xy.data()),
        artificial_xx(s.artificial_stress.xx.data()),
        artificial_yy(s.artificial_stress.yy.data()),
        artificial_xy(s.artificial_stress.xy.data()) {}

  [[gnu::always_inline]] HypoelasticState<Pack> at(std::int64_t row) const {
    return {load(x + row),
            load(y + row),
            load(velocity_x + row),
            load(velocity_y + row),
            load(density + row),
            load(mass + row),
            load(volume + row),
            {load(stress_xx + row), load(stress_yy + row), load(stress_xy + row)},
            {load(artificial_xx + row), load(artificial_yy + row), load(artificial_xy + row)}};
  }

  const double *x, *y, *velocity_x, *velocity_y, *density, *mass, *volume, *stress_xx, *stress_yy, *stress_xy,
      *artificial_xx, *artificial_yy, *artificial_xy;
};

// What the steps of three pairs hold needs the 32 registers that come with vectors of eight.
constexpr bool steps_side_by_side = pack_size == 8;

/// Evaluates what a pack of rows keeps, the steps of three pairs side by side.
template <class Parameters, class Shared>
void keep_interactions(const Parameters& shared_parameters, const SolidParticles& s, std::int64_t row,
                       std::span<const PairSharing::Kept> kept, Shared shared) {
  const Parameters parameters = shared_parameters;
  const Columns columns(s);
  const HypoelasticState<Pack> i = columns.at(row);
  const auto neighbour = [&](std::size_t k) __attribute__((always_inline)) {
    return columns.at(row + kept[k].offset);
  };
  if constexpr (!steps_side_by_side) {
    for (const PairSharing::Kept& pair : kept) {
      const HypoelasticState<Pack> j = columns.at(row + pair.offset);
      const InverseSeparation<Pack> separation(Separation<Pack>(i.x - j.x, i.y - j.y), parameters.viscosity, i.density,
                                               j.density);
      shared.keep(pair.slot, row, hypoelastic_interaction(parameters, separation, i, j));
    }
    return;
  }
  InverseSeparation<Pack> next;
  Separation<Pack> after_next;
  const auto separate_next = [&](std::size_t k) __attribute__((always_inline)) {
    if (k >= kept.size()) return;
    const HypoelasticState<Pack> j = neighbour(k);
    after_next = Separation<Pack>(i.x - j.x, i.y - j.y);
  };
  const auto invert_next = [&](std::size_t k) __attribute__((always_inline)) {
    if (k < kept.size())
      next = InverseSeparation<Pack>(after_next, parameters.viscosity, i.density, neighbour(k).density);
  };
  separate_next(0);
  invert_next(0);
  separate_next(1);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const InverseSeparation<Pack> now = next;
    invert_next(k + 1);
    separate_next(k + 2);
    shared.keep(kept[k].slot, row, hypoelastic_interaction(parameters, now, i, neighbour(k)));
  }
}

/// The list of a block: offsets, and where their interactions are kept.
struct Entries {
  const std::int32_t* offsets;
  const std::int32_t* slots;
  std::int32_t count;
};

template <class Parameters, class Shared>
void set_rates(const HypoelasticParameters& general, const Parameters& shared_parameters, SolidParticles& s,
               std::int64_t row, const Entries& shared_entries, Shared shared) {
  const Parameters parameters = shared_parameters;
  const Entries entries = shared_entries;
  const Columns columns(s);
  const HypoelasticState<Pack> i = columns.at(row);
  const Pack inverse_density = Pack(1.0) / load(s.density.data() + row);
  HypoelasticRates<Pack> rates;
  for (std::int32_t k = 0; k < entries.count; ++k) {
    const std::int32_t offset = entries.offsets[k], slot = entries.slots[k];
    const std::int64_t j = row + offset;
    if (slot == PairSharing::none)
      add_hypoelastic_pair(parameters, i, inverse_density, columns.at(j), rates);
    else if (offset < 0)
      add_interaction<SeenFrom::second>(shared.kept(slot, j), i, inverse_density, columns.at(j), rates);
    else
      add_interaction<SeenFrom::first>(shared.kept(slot, row), i, inverse_density, columns.at(j), rates);
  }

  const SymmetricTensor<Pack> deviatoric{load(s.deviatoric_stress.xx.data() + row),
                                         load(s.deviatoric_stress.yy.data() + row),
                                         load(s.deviatoric_stress.xy.data() + row)};
  const auto stress_rate =
      jaumann_stress_rate(rates.gradient, deviatoric, general.material.shear_modulus(), general.trace_factor);
  store(rates.density_rate, s.density_rate.data() + row);
  store(rates.acceleration_x + rates.artificial_x, s.acceleration.x.data() + row);
  store(rates.acceleration_y + rates.artificial_y, s.acceleration.y.data() + row);
  store(stress_rate.xx, s.deviatoric_stress_rate.xx.data() + row);
  store(stress_rate.yy, s.deviatoric_stress_rate.yy.data() + row);
  store(stress_rate.xy, s.deviatoric_stress_rate.xy.data() + row);
  store(rates.dissipation_rate, s.dissipation_rate.data() + row);
  store(load(s.velocity.x.data() + row) * rates.artificial_x + load(s.velocity.y.data() + row) * rates.artificial_y,
        s.artificial_stress_power.data() + row);
}

template <std::int64_t rows, class Parameters>
void sweep(const HypoelasticParameters& general, const Parameters& parameters, SolidParticles& s,
           const OffsetNeighbours& list, bool with_ghosts, Column<double>& values) {
  using Shared = SharedInteractions<rows>;
  const PairSharing& sharing = list.sharing;
  if (values.size() < Shared::size(sharing.slot_count)) values.resize(Shared::size(sharing.slot_count));
  const Shared shared(values.data());
  for (std::size_t b = 0; b < list.blocks.size(); ++b) {
    const OffsetNeighbours::Block& block = list.blocks[b];
    if (block.needs_ghosts != with_ghosts) continue;
    const auto kept = std::span(sharing.kept)
                          .subspan(static_cast<std::size_t>(sharing.first_kept[b]),
                                   static_cast<std::size_t>(sharing.first_kept[b + 1] - sharing.first_kept[b]));
    const Entries entries{list.offsets.data() + block.first_offset, sharing.slots.data() + block.first_offset,
                          block.offsets};
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size)
      keep_interactions(parameters, s, block.first_row + lane, kept, shared);
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size)
      set_rates(general, parameters, s, block.first_row + lane, entries, shared);
  }
}

}  // namespace

void HypoelasticSweep::update_stress(SolidParticles& s, std::span<const RowRange> rows) const {
  const double sound_speed = parameters_.material.sound_speed();
  const double reference_density = parameters_.material.density;
  for (const RowRange& range : rows) {
    // Rows past the range are computed too where it ends inside a pack: the next call, or nobody, needs them.
    for (std::int64_t row = range.begin; row < range.end; row += pack_size) {
      const Pack density = load(s.density.data() + row);
      const Pack pressure = equation_of_state_pressure(density, sound_speed, reference_density);
      const SymmetricTensor<Pack> stress{load(s.deviatoric_stress.xx.data() + row) - pressure,
                                         load(s.deviatoric_stress.yy.data() + row) - pressure,
                                         load(s.deviatoric_stress.xy.data() + row)};
      const auto artificial = artificial_stress(stress, density, parameters_.artificial_stress_coefficient);
      store(pressure, s.pressure.data() + row);
      store(load(s.mass.data() + row) / density, s.volume.data() + row);
      store(stress.xx, s.stress.xx.data() + row);
      store(stress.yy, s.stress.yy.data() + row);
      store(stress.xy, s.stress.xy.data() + row);
      store(artificial.xx, s.artificial_stress.xx.data() + row);
      store(artificial.yy, s.artificial_stress.yy.data() + row);
      store(artificial.xy, s.artificial_stress.xy.data() + row);
    }
  }
}

void HypoelasticSweep::apply(SolidParticles& s, const OffsetNeighbours& list, Blocks which) const {
  const bool with_ghosts = which == Blocks::with_ghosts;
  const auto sweep_with = [&](const auto& pair) {
    constexpr auto rows = PairSharing::row_choices;
    if (list.sharing.rows == rows[0])
      sweep<rows[0]>(parameters_, pair, s, list, with_ghosts, shared_);
    else if (list.sharing.rows == rows[1])
      sweep<rows[1]>(parameters_, pair, s, list, with_ghosts, shared_);
    else
      sweep<rows[2]>(parameters_, pair, s, list, with_ghosts, shared_);
  };
  const HypoelasticPairParameters& pair = parameters_.pair;
  if (pair.viscosity.beta == 0.0)
    sweep_with(HypoelasticPairParametersWith<LinearArtificialViscosity>{
        pair.kernel, LinearArtificialViscosity(pair.viscosity), pair.inverse_kernel_at_spacing});
  else
    sweep_with(pair);
}

}  // namespace sphdrop
