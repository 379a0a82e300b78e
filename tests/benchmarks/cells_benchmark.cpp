// What a particle of a solid of cells costs in a step, on one core. Read the minima: other processes only add time.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <vector>

#include "particles/elementary_functions.hpp"
#include "solid/cells/cell_sweep.hpp"
#include "time_integration/leapfrog.hpp"

namespace {

using namespace sphdrop;

constexpr double spacing = 2.5e-5, density = 1000.0, step = 2e-8;

double minimum(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

/// A free beam of 10 rows, gently bending.
template <class Law>
struct Beam {
  explicit Beam(std::int64_t particles, double damping_time) : sweep(material(damping_time)) {
    constexpr int rows = 10;
    const auto count = static_cast<std::size_t>(particles);
    std::vector<Vector> positions;
    for (std::size_t k = 0; k < count; ++k)
      positions.push_back({static_cast<double>(k / rows) * spacing, static_cast<double>(k % rows) * spacing});
    const LatticeCells lattice(positions, std::vector<char>(count, 0), spacing, false);
    solid.resize(count);
    solid.owned = {{0, static_cast<std::int32_t>(count)}};
    for (std::size_t row = 0; row < count; ++row) {
      solid.id[row] = static_cast<std::int64_t>(row);
      solid.mass[row] = density * spacing * spacing;
      solid.position.set(row, positions[row]);
      solid.staggered_velocity.set(
          row, {0, 1e-3 * sine_cosine(3.14 * static_cast<double>(row) / static_cast<double>(count)).sine});
    }
    sweep.set_mesh(CellMesh(solid, lattice, 0));
  }

  static AnyCellMaterial material(double damping_time) {
    CellMaterial<Law> m;
    m.law.moduli = LameModuli(ElasticMaterial{density, 300e6, 0.3});
    m.bending_modulus = 300e6 / 0.91;
    m.spacing = spacing;
    m.damping_time = damping_time;
    return m;
  }

  SolidParticles solid;
  CellSweep sweep;
};

template <class Work>
void measure(benchmark::State& state, std::int64_t particles, const Work& work) {
  const std::clock_t start = std::clock();
  for ([[maybe_unused]] auto _ : state) {
    work();
    benchmark::ClobberMemory();
  }
  const double seconds = static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC);
  state.counters["ns_per_particle_step"] = 1e9 * seconds / static_cast<double>(state.iterations() * particles);
}

template <class Law>
void forces(benchmark::State& state) {
  Beam<Law> beam(state.range(0), 0);
  predict_velocity(beam.solid, 0);
  measure(state, state.range(0), [&] { beam.sweep.sweep(beam.solid, CellSweep::Cells::without_ghosts); });
}

void accelerations(benchmark::State& state) {
  Beam<StVenantKirchhoff> beam(state.range(0), 0);
  measure(state, state.range(0), [&] { beam.sweep.accelerate(beam.solid); });
}

void whole_step(benchmark::State& state, double damping_time) {
  Beam<StVenantKirchhoff> beam(state.range(0), damping_time);
  double previous = 0;
  const double taken = damping_time > 0 ? 0.1 * step : step;
  measure(state, state.range(0), [&] {
    predict_velocity(beam.solid, previous);
    beam.sweep.sweep(beam.solid, CellSweep::Cells::without_ghosts);
    beam.sweep.accelerate(beam.solid);
    if (kick_and_drift_velocity(beam.solid, {previous, taken}, 10.0, damping_time > 0).beyond_limit)
      state.SkipWithError("the beam has come apart");
    previous = taken;
  });
}

void repeat(benchmark::internal::Benchmark* b) {
  b->Arg(1000)->Arg(10000)->Repetitions(7)->MinTime(0.2)->ReportAggregatesOnly(true)->ComputeStatistics("min", minimum);
}
BENCHMARK_TEMPLATE(forces, StVenantKirchhoff)->Apply(repeat);
BENCHMARK_TEMPLATE(forces, NeoHookean)->Apply(repeat);
BENCHMARK(accelerations)->Apply(repeat);
BENCHMARK_CAPTURE(whole_step, undamped, 0.0)->Apply(repeat);
BENCHMARK_CAPTURE(whole_step, damped, 1e-9)->Apply(repeat);

}  // namespace
