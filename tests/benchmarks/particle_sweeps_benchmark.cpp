// What a particle costs in a step, on one core: sweeps, stresses and leap-frog of either material; and what the core
// could do at best. Read the minima: other processes only ever add time.

#include <benchmark/benchmark.h>
#if defined(__FMA__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numbers>
#include <tuple>
#include <vector>

#include "fluid/density_correction.hpp"
#include "fluid/fluid_sweep.hpp"
#include "particles/pack.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "sph/equation_of_state.hpp"
#include "time_integration/leapfrog.hpp"

namespace {

using namespace sphdrop;

constexpr double spacing = 2.5e-5, smoothing_length = 1.2 * spacing, reference_density = 1000.0;
constexpr double reach = 2 * smoothing_length + 0.3 * spacing;
constexpr double step = 5e-9;
constexpr CubicSpline kernel(smoothing_length);

double minimum(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

void repeat(benchmark::internal::Benchmark* b) {
  b->Repetitions(7)->MinTime(0.2)->ReportAggregatesOnly(true)->ComputeStatistics("min", minimum);
}

/// Reports what a step cost each of `particles` from here to the end of the loop, in processor time.
class StepCost {
 public:
  explicit StepCost(std::size_t particles, int steps_an_iteration = 1)
      : particles_(static_cast<std::int64_t>(particles)), steps_(steps_an_iteration), start_(std::clock()) {}

  /// `lanes`: how many pairs are computed, padding and what is out of reach among them.
  void report(benchmark::State& state, std::int64_t pairs, std::int64_t lanes) const {
    const double seconds = static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
    const std::int64_t work = state.iterations() * particles_ * steps_;
    state.SetItemsProcessed(work);
    state.counters["ns_per_particle_step"] = 1e9 * seconds / static_cast<double>(work);
    state.counters["neighbours"] = static_cast<double>(pairs) / static_cast<double>(particles_);
    state.counters["lanes"] = static_cast<double>(lanes) / static_cast<double>(particles_);
  }

 private:
  std::int64_t particles_;
  int steps_;
  std::clock_t start_;
};

/// A free beam of 10 rows in lattice order, gently bending.
struct Beam {
  explicit Beam(int columns) {
    constexpr int rows = 10;
    const int particles = columns * rows;
    solid.resize(static_cast<std::size_t>(particles));
    solid.owned = {{0, particles}};
    for (int k = 0; k < particles; ++k) {
      const auto row = static_cast<std::size_t>(k);
      const int column = k / rows;
      const Vector p{column * spacing, (k % rows) * spacing};
      solid.id[row] = k;
      solid.position.set(row, p);
      solid.staggered_velocity.set(row, {0, 1e-3 * std::sin(std::numbers::pi * p.x / (columns * spacing))});
      solid.staggered_density[row] = reference_density;
      solid.mass[row] = reference_density * spacing * spacing;
      solid.is_fixed[row] = 0.0;
    }
    list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, reach);
    predict(solid, 0.0);
  }

  static HypoelasticParameters parameters() {
    const ElasticMaterial material{reference_density, 300e6, 0.3};
    return {{kernel, {2.0, 0.0, material.sound_speed(), smoothing_length}, 1.0 / kernel.value(spacing)},
            material,
            1.0 / 3,
            0.2};
  }

  std::int64_t lanes() const { return block_size * static_cast<std::int64_t>(list.offsets.size()); }

  SolidParticles solid;
  OffsetNeighbours list;
  HypoelasticSweep sweep{parameters()};
};

void hypoelastic_sweep(benchmark::State& state) {
  Beam beam(static_cast<int>(state.range(0)) / 10);
  beam.sweep.update_stress(beam.solid, beam.solid.owned);
  const StepCost cost(beam.solid.size());
  for ([[maybe_unused]] auto _ : state) {
    beam.sweep.apply(beam.solid, beam.list, HypoelasticSweep::Blocks::without_ghosts);
    benchmark::ClobberMemory();
  }
  cost.report(state, beam.list.pairs, beam.lanes());
}
BENCHMARK(hypoelastic_sweep)->Arg(1000)->Arg(10000)->Apply(repeat);

void hypoelastic_step(benchmark::State& state) {
  Beam beam(static_cast<int>(state.range(0)) / 10);
  double previous = 0;
  const StepCost cost(beam.solid.size());
  // As in HypoelasticStep.
  const auto predict_rows = [&](std::span<const RowRange> rows) {
    predict(beam.solid, rows, previous);
    beam.sweep.update_stress(beam.solid, rows);
  };
  for_each_run(beam.solid.owned, predict_rows);
  for ([[maybe_unused]] auto _ : state) {
    beam.sweep.apply(beam.solid, beam.list, HypoelasticSweep::Blocks::without_ghosts);
    const StepLengths steps{previous, step};
    previous = step;
    const MotionMaxima maxima = kick_and_drift(beam.solid, steps, 10.0, predict_rows);
    if (maxima.beyond_limit) {
      state.SkipWithError("the beam has come apart");
      break;
    }
  }
  cost.report(state, beam.list.pairs, beam.lanes());
}
BENCHMARK(hypoelastic_step)->Arg(1000)->Arg(10000)->Apply(repeat);

/// A drop of concentric rings, about `particles` of them; rows by cell, so that neighbours are near in memory.
struct Drop {
  explicit Drop(int particles) {
    const int rings = static_cast<int>(std::lround(std::sqrt(particles / std::numbers::pi)));
    struct Placed {
      Vector position;
      double mass;
    };
    std::vector<Placed> placed;
    for (int k = 0; k < rings; ++k) {
      const auto count = static_cast<int>(std::lround(2 * std::numbers::pi * (k + 0.5)));
      const double mass = reference_density * std::numbers::pi * (2 * k + 1) * spacing * spacing / count;
      for (int n = 0; n < count; ++n) {
        const double angle = 2 * std::numbers::pi * n / count, r = (k + 0.5) * spacing;
        placed.push_back({{r * std::cos(angle), r * std::sin(angle)}, mass});
      }
    }
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
      const auto key = [](const Placed& p) {
        return std::tuple(std::floor(p.position.y / reach), std::floor(p.position.x / reach), p.position.x,
                          p.position.y);
      };
      return key(a) < key(b);
    });
    fluid.resize(placed.size());
    fluid.owned = {{0, static_cast<std::int32_t>(placed.size())}};
    for (std::size_t row = 0; row < placed.size(); ++row) {
      fluid.id[row] = static_cast<std::int64_t>(row);
      fluid.position.set(row, placed[row].position);
      fluid.mass[row] = placed[row].mass;
      // An oscillation just begun.
      fluid.staggered_velocity.set(row, {placed[row].position.x, -placed[row].position.y});
      fluid.staggered_density[row] = reference_density;
    }
    list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], reach);
    sweep.resize(fluid);
    corrected.resize(fluid.size() + column_padding);
    predict(fluid, 0.0);
    set_pressure();
  }

  void set_pressure() {
    fluid.for_each_owned([&](std::size_t row) {
      fluid.pressure[row] = equation_of_state_pressure(fluid.density[row], sound_speed, reference_density);
    });
  }
  void correct_density() {
    moving_least_squares_densities(fluid, list, kernel, spacing, corrected);
    fluid.for_each_owned([&](std::size_t row) {
      fluid.staggered_density[row] += corrected[row] - fluid.density[row];
      fluid.density[row] = corrected[row];
    });
  }

  std::int64_t lanes() const { return static_cast<std::int64_t>(list.neighbours.size()); }

  static constexpr double sound_speed = 50;
  FluidParticles fluid;
  SlicedNeighbours list;
  FluidSweep sweep{FluidPairParameters<>{kernel, {0.1, 0.0, sound_speed, smoothing_length}}};
  std::vector<double> corrected;
};

void fluid_sweep(benchmark::State& state) {
  Drop drop(static_cast<int>(state.range(0)));
  drop.sweep.pack(drop.fluid, drop.fluid.owned);
  const StepCost cost(drop.fluid.size());
  for ([[maybe_unused]] auto _ : state) {
    drop.sweep.apply(drop.fluid, drop.list);
    benchmark::ClobberMemory();
  }
  cost.report(state, drop.list.pairs, drop.lanes());
}
BENCHMARK(fluid_sweep)->Arg(1264)->Arg(10000)->Apply(repeat);

void density_correction(benchmark::State& state) {
  Drop drop(static_cast<int>(state.range(0)));
  const StepCost cost(drop.fluid.size());
  for ([[maybe_unused]] auto _ : state) {
    moving_least_squares_densities(drop.fluid, drop.list, kernel, spacing, drop.corrected);
    benchmark::ClobberMemory();
  }
  cost.report(state, drop.list.pairs, drop.lanes());
}
BENCHMARK(density_correction)->Arg(1264)->Arg(10000)->Apply(repeat);

// Twenty steps, one of them with the density correction.
void fluid_step(benchmark::State& state) {
  constexpr int correction_interval = 20;
  Drop drop(static_cast<int>(state.range(0)));
  double previous = 0;
  const StepCost cost(drop.fluid.size(), correction_interval);
  for ([[maybe_unused]] auto _ : state) {
    bool beyond_limit = false;
    for (int k = 0; k < correction_interval; ++k) {
      predict(drop.fluid, previous);
      if (k == 0) drop.correct_density();
      drop.set_pressure();
      drop.sweep.pack(drop.fluid, drop.fluid.owned);
      drop.sweep.apply(drop.fluid, drop.list);
      beyond_limit = kick_and_drift(drop.fluid, {previous, step}, 10.0).beyond_limit || beyond_limit;
      previous = step;
    }
    if (beyond_limit) {
      state.SkipWithError("the drop has come apart");
      break;
    }
  }
  cost.report(state, drop.list.pairs, drop.lanes());
}
BENCHMARK(fluid_step)->Arg(1264)->Arg(10000)->Apply(repeat);

// Independent accumulators in registers: `chains` vectors, enough to hide the latency of an operation.
constexpr int chains = 16;

template <class Operation>
void peak(benchmark::State& state, Operation operation) {
  constexpr int rounds = 1000;
  double values[chains][pack_size];
  for (auto& chain : values) std::fill(std::begin(chain), std::end(chain), 0.5);
  const Pack factor(0.999), term(1e-3);
  for ([[maybe_unused]] auto _ : state) {
    Pack accumulators[chains];
    for (int c = 0; c < chains; ++c) accumulators[c] = load(values[c]);
    for (int k = 0; k < rounds; ++k)
      for (Pack& accumulator : accumulators) accumulator = operation(accumulator, factor, term);
    for (int c = 0; c < chains; ++c) store(accumulators[c], values[c]);
    benchmark::ClobberMemory();
  }
  benchmark::DoNotOptimize(values);
  state.counters["GFLOP_per_s"] =
      benchmark::Counter(2e-9 * rounds * chains * pack_size, benchmark::Counter::kIsIterationInvariantRate);
}

void repeat_for_maximum(benchmark::internal::Benchmark* b) {
  b->Repetitions(7)->MinTime(0.1)->ReportAggregatesOnly(true)->ComputeStatistics(
      "max", [](const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); });
}

/// What separate multiplications and additions reach: the program's own ceiling.
void multiply_add_peak(benchmark::State& state) {
  peak(state, [](const Pack& a, const Pack& b, const Pack& c) { return a * b + c; });
}
BENCHMARK(multiply_add_peak)->Apply(repeat_for_maximum);

#if defined(__FMA__)
Pack fused_multiply_add(const Pack& a, const Pack& b, const Pack& c) {
#if defined(__AVX512F__)
  return Pack(_mm512_fmadd_pd(static_cast<__m512d>(a), static_cast<__m512d>(b), static_cast<__m512d>(c)));
#else
  return Pack(_mm256_fmadd_pd(static_cast<__m256d>(a), static_cast<__m256d>(b), static_cast<__m256d>(c)));
#endif
}

/// The core's peak, which fused multiply-adds alone reach. The program does without them for reproducibility.
void fused_multiply_add_peak(benchmark::State& state) {
  peak(state, [](const Pack& a, const Pack& b, const Pack& c) { return fused_multiply_add(a, b, c); });
}
BENCHMARK(fused_multiply_add_peak)->Apply(repeat_for_maximum);
#endif

}  // namespace
