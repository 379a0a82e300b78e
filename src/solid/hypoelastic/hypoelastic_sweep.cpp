#include "solid/hypoelastic/hypoelastic_sweep.hpp"

#include "particles/pack.hpp"
#include "solid/hypoelastic/artificial_stress.hpp"
#include "sph/equation_of_state.hpp"

namespace sphdrop {

namespace {

[[gnu::always_inline]] inline HypoelasticState<Pack> load_state(const SolidParticles& s, std::int64_t row) {
  return {load(s.position.x.data() + row),
          load(s.position.y.data() + row),
          load(s.velocity.x.data() + row),
          load(s.velocity.y.data() + row),
          load(s.density.data() + row),
          load(s.mass.data() + row),
          load(s.volume.data() + row),
          {load(s.stress.xx.data() + row), load(s.stress.yy.data() + row), load(s.stress.xy.data() + row)},
          {load(s.artificial_stress.xx.data() + row), load(s.artificial_stress.yy.data() + row),
           load(s.artificial_stress.xy.data() + row)}};
}

/// The list of a block: offsets, and where their interactions are kept.
struct Entries {
  const std::int32_t* offsets;
  const std::int32_t* slots;
  std::int32_t count;
};

// In two loops: evaluating waits for divisions and roots, which follow each other closely where no sums are in the way.
void keep_interactions(const HypoelasticPairParameters& shared_parameters, const SolidParticles& s, std::int64_t row,
                       const Entries& entries, SharedInteractions::Places shared) {
  const HypoelasticPairParameters parameters = shared_parameters;
  const HypoelasticState<Pack> i = load_state(s, row);
  for (std::int32_t k = 0; k < entries.count; ++k)
    if (entries.offsets[k] > 0 && entries.slots[k] != PairSharing::none)
      shared.keep(entries.slots[k], row,
                  hypoelastic_interaction(parameters, i, load_state(s, row + entries.offsets[k])));
}

void set_rates(const HypoelasticParameters& shared_parameters, SolidParticles& s, std::int64_t row,
               const Entries& entries, SharedInteractions::Places shared) {
  const HypoelasticPairParameters parameters = shared_parameters.pair;
  const double *mass = s.mass.data(), *volume = s.volume.data();
  const Pack inverse_density = Pack(1.0) / load(s.density.data() + row);
  HypoelasticRates<Pack> rates;
  for (std::int32_t k = 0; k < entries.count; ++k) {
    const std::int32_t offset = entries.offsets[k], slot = entries.slots[k];
    const std::int64_t j = row + offset;
    if (slot == PairSharing::none)
      add_hypoelastic_pair(parameters, load_state(s, row), inverse_density, load_state(s, j), rates);
    else if (offset < 0)
      add_interaction<SeenFrom::second>(shared.kept(slot, j), inverse_density, load(mass + j), load(volume + j), rates);
    else
      add_interaction<SeenFrom::first>(shared.kept(slot, row), inverse_density, load(mass + j), load(volume + j),
                                       rates);
  }

  const SymmetricTensor<Pack> deviatoric{load(s.deviatoric_stress.xx.data() + row),
                                         load(s.deviatoric_stress.yy.data() + row),
                                         load(s.deviatoric_stress.xy.data() + row)};
  const auto stress_rate = jaumann_stress_rate(rates.gradient, deviatoric, shared_parameters.material.shear_modulus(),
                                               shared_parameters.trace_factor);
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
  shared_.resize(list.sharing);
  const SharedInteractions::Places shared = shared_.places();
  for (const OffsetNeighbours::Block& block : list.blocks) {
    if (block.needs_ghosts != (which == Blocks::with_ghosts)) continue;
    const Entries entries{list.offsets.data() + block.first_offset, list.sharing.slots.data() + block.first_offset,
                          block.offsets};
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size)
      keep_interactions(parameters_.pair, s, block.first_row + lane, entries, shared);
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size)
      set_rates(parameters_, s, block.first_row + lane, entries, shared);
  }
}

}  // namespace sphdrop
