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
  const HypoelasticPairParameters pair = parameters_.pair;
  const double shear_modulus = parameters_.material.shear_modulus();
  const double trace_factor = parameters_.trace_factor;
  for (const OffsetNeighbours::Block& block : list.blocks) {
    if (block.needs_ghosts != (which == Blocks::with_ghosts)) continue;
    const std::int32_t* offsets = list.offsets.data() + block.first_offset;
    for (std::int32_t lane = 0; lane < block_size; lane += pack_size) {
      const std::int64_t row = block.first_row + lane;
      const HypoelasticState<Pack> i = load_state(s, row);
      const Pack inverse_density = Pack(1.0) / i.density;
      HypoelasticRates<Pack> rates;
      for (std::int32_t k = 0; k < block.offsets; ++k)
        add_hypoelastic_pair(pair, i, inverse_density, load_state(s, row + offsets[k]), rates);

      const SymmetricTensor<Pack> deviatoric{load(s.deviatoric_stress.xx.data() + row),
                                             load(s.deviatoric_stress.yy.data() + row),
                                             load(s.deviatoric_stress.xy.data() + row)};
      const auto stress_rate = jaumann_stress_rate(rates.gradient, deviatoric, shear_modulus, trace_factor);
      store(rates.density_rate, s.density_rate.data() + row);
      store(rates.acceleration_x + rates.artificial_x, s.acceleration.x.data() + row);
      store(rates.acceleration_y + rates.artificial_y, s.acceleration.y.data() + row);
      store(stress_rate.xx, s.deviatoric_stress_rate.xx.data() + row);
      store(stress_rate.yy, s.deviatoric_stress_rate.yy.data() + row);
      store(stress_rate.xy, s.deviatoric_stress_rate.xy.data() + row);
      store(rates.dissipation_rate, s.dissipation_rate.data() + row);
      store(i.velocity_x * rates.artificial_x + i.velocity_y * rates.artificial_y,
            s.artificial_stress_power.data() + row);
    }
  }
}

}  // namespace sphdrop
