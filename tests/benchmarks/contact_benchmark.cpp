// What contact costs: 100 particles over the free end of a cantilever, some four candidate segments each.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "contact/contact_solver.hpp"

namespace {

using namespace sphdrop;

/// Lengths in units of d: a flat row of vertices and rows of liquid above it, the lowest one `overlap` too near.
struct Layer {
  std::vector<double> x, y, mass, acceleration_x, acceleration_y, vertex_x, vertex_y, force_x, force_y;
  std::vector<Segment> segments;

  Layer(int particles, double overlap) {
    std::vector<std::int32_t> line;
    for (int k = 0; k <= particles; ++k) {
      line.push_back(k);
      vertex_x.push_back(k);
      vertex_y.push_back(0.0);
    }
    segments = segments_of_polylines(std::vector<std::vector<std::int32_t>>{line});
    for (int i = 0; i < particles; ++i) {
      x.push_back(i + 0.3 + 0.1 * (i % 5));
      y.push_back(1.0 - overlap);
      mass.push_back(1.0);
    }
    acceleration_x.assign(x.size(), 0.0);
    acceleration_y.assign(x.size(), 0.0);
    force_x.assign(vertex_x.size(), 0.0);
    force_y.assign(vertex_x.size(), 0.0);
  }
};

constexpr double reach = 1.9;

void contact_forces(benchmark::State& state) {
  Layer layer(static_cast<int>(state.range(0)), 0.05);
  ContactSolver solver;
  solver.rebuild(layer.x, layer.y, layer.vertex_x, layer.vertex_y, layer.segments, reach);
  std::size_t candidates = 0;
  for (std::size_t a = 0; a < solver.active_particles().size(); ++a) candidates += solver.candidates(a).size();
  for ([[maybe_unused]] auto _ : state) {
    const ContactSummary summary =
        solver.apply({layer.x, layer.y, layer.mass, layer.acceleration_x, layer.acceleration_y},
                     {layer.vertex_x, layer.vertex_y, layer.force_x, layer.force_y}, {1.0, 1.0, 0.2});
    benchmark::DoNotOptimize(summary);
    benchmark::ClobberMemory();
  }
  state.counters["candidates"] = static_cast<double>(candidates) / static_cast<double>(layer.x.size());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(contact_forces)->Arg(100)->Arg(1000);

void contact_search(benchmark::State& state) {
  const Layer layer(static_cast<int>(state.range(0)), 0.05);
  ContactSolver solver;
  for ([[maybe_unused]] auto _ : state) {
    solver.rebuild(layer.x, layer.y, layer.vertex_x, layer.vertex_y, layer.segments, reach);
    benchmark::DoNotOptimize(solver.active_particles().data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(contact_search)->Arg(100)->Arg(1000)->Arg(10000);

}  // namespace
