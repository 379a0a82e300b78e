// Surface tension of a drop of 1264 particles, 1 mm across: what a step costs, and what a new detection costs.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "surface_tension/arc_search.hpp"
#include "surface_tension/boundary_detection.hpp"
#include "surface_tension/force_sharing.hpp"
#include "surface_tension/surface_curve.hpp"
#include "surface_tension/surface_force.hpp"
#include "surface_tension/surface_points.hpp"

namespace {

using namespace sphdrop;

constexpr double spacing = 2.5e-5;
constexpr double smoothing_length = 1.2 * spacing;
constexpr double circle_radius = 2.0 * smoothing_length;
constexpr double reach = circle_radius + 0.2 * spacing;

struct Drop {
  std::vector<std::int64_t> ids;
  std::vector<Vector> positions;
  std::vector<std::int32_t> order;
  std::vector<double> x, y;
  std::vector<std::vector<std::int64_t>> ids_nearby;  // within 4h, by particle
  std::vector<std::vector<Vector>> nearby;
  std::vector<Arc> arcs;
  std::vector<Vector> arc_centres;
  SurfaceCurves curves;
  std::vector<Vector> nodes, points, forces;

  Drop() {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> shift(-0.05 * spacing, 0.05 * spacing);
    for (int ring = 0; ring < 20; ++ring) {
      const double radius = (ring + 0.5) * spacing;
      const auto count = ring == 19 ? 130 : static_cast<int>(std::lround(2.0 * std::numbers::pi * (ring + 0.5)));
      for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        positions.push_back(radius * Vector{std::cos(angle), std::sin(angle)} +
                            Vector{shift(generator), shift(generator)});
      }
    }
    for (const Vector position : positions) {
      ids.push_back(static_cast<std::int64_t>(ids.size()));
      x.push_back(position.x);
      y.push_back(position.y);
    }
    order.resize(x.size());
    std::iota(order.begin(), order.end(), 0);
    for (const Vector centre : positions) {
      ids_nearby.emplace_back();
      nearby.emplace_back();
      for (std::size_t j = 0; j < positions.size(); ++j) {
        const double distance = length(positions[j] - centre);
        if (distance > 2.0 * circle_radius || distance == 0.0) continue;
        ids_nearby.back().push_back(ids[j]);
        nearby.back().push_back(positions[j]);
      }
    }
    ArcFinder finder(circle_radius);
    for (std::size_t i = 0; i < ids.size(); ++i) finder.find(ids[i], positions[i], ids_nearby[i], nearby[i], arcs);
    for (const Arc& arc : arcs) arc_centres.push_back(positions[static_cast<std::size_t>(arc.particle)]);
    curves = connect_arcs(arcs, arc_centres, circle_radius);
    for (const auto& node : curves.nodes) nodes.push_back(positions[static_cast<std::size_t>(node.particle)]);
    points.resize(nodes.size());
    forces.resize(nodes.size());
    surface_points(curves, nodes, spacing, points);
    conservative_forces(curves, points, 0.072, forces);
  }

  void report(benchmark::State& state) const {
    state.counters["particles"] = static_cast<double>(ids.size());
    state.counters["nodes"] = static_cast<double>(nodes.size());
  }
};

void detection(benchmark::State& state) {
  Drop drop;
  ArcFinder finder(circle_radius);
  for (auto _ : state) {
    drop.arcs.clear();
    for (std::size_t i = 0; i < drop.ids.size(); ++i)
      finder.find(drop.ids[i], drop.positions[i], drop.ids_nearby[i], drop.nearby[i], drop.arcs);
    benchmark::DoNotOptimize(drop.arcs.data());
  }
  drop.report(state);
}
BENCHMARK(detection)->Unit(benchmark::kMicrosecond);

// As a run does it: of all particles together.
void search(benchmark::State& state) {
  Drop drop;
  ArcSearch finder(circle_radius);
  std::vector<Vector> centres;
  for (auto _ : state) {
    drop.arcs.clear();
    centres.clear();
    finder.find(drop.x, drop.y, drop.ids, drop.ids.size(), drop.arcs, centres);
    benchmark::DoNotOptimize(drop.arcs.data());
  }
  drop.report(state);
}
BENCHMARK(search)->Unit(benchmark::kMicrosecond);

// Likewise, without the walks round circles.
void sorting_out(benchmark::State& state) {
  Drop drop;
  ArcSearch finder(circle_radius);
  std::vector<Vector> centres;
  for (auto _ : state) {
    drop.arcs.clear();
    finder.find(drop.x, drop.y, drop.ids, 0, drop.arcs, centres);
    benchmark::DoNotOptimize(drop.arcs.data());
  }
  drop.report(state);
}
BENCHMARK(sorting_out)->Unit(benchmark::kMicrosecond);

void connection(benchmark::State& state) {
  Drop drop;
  for (auto _ : state) benchmark::DoNotOptimize(connect_arcs(drop.arcs, drop.arc_centres, circle_radius));
  drop.report(state);
}
BENCHMARK(connection)->Unit(benchmark::kMicrosecond);

void points(benchmark::State& state) {
  Drop drop;
  for (auto _ : state) {
    surface_points(drop.curves, drop.nodes, spacing, drop.points);
    benchmark::ClobberMemory();
  }
  drop.report(state);
}
BENCHMARK(points)->Unit(benchmark::kMicrosecond);

void conservative(benchmark::State& state) {
  Drop drop;
  for (auto _ : state) {
    conservative_forces(drop.curves, drop.points, 0.072, drop.forces);
    benchmark::ClobberMemory();
  }
  drop.report(state);
}
BENCHMARK(conservative)->Unit(benchmark::kMicrosecond);

void curvature(benchmark::State& state) {
  Drop drop;
  for (auto _ : state) {
    curvature_forces(drop.curves, drop.points, 0.072, static_cast<int>(state.range(0)), drop.forces);
    benchmark::ClobberMemory();
  }
  drop.report(state);
}
BENCHMARK(curvature)->Arg(3)->Arg(5)->Unit(benchmark::kMicrosecond);

void candidates(benchmark::State& state) {
  Drop drop;
  ForceSharing sharing;
  for (auto _ : state) {
    sharing.rebuild(drop.points, drop.positions, drop.order, reach);
    benchmark::ClobberMemory();
  }
  drop.report(state);
}
BENCHMARK(candidates)->Unit(benchmark::kMicrosecond);

void sharing(benchmark::State& state) {
  Drop drop;
  ForceSharing sharing;
  sharing.rebuild(drop.points, drop.positions, drop.order, reach);
  const CubicSpline kernel(smoothing_length);
  drop.positions.push_back(ForceSharing::far_away);
  for (auto _ : state) {
    benchmark::DoNotOptimize(sharing.share(drop.points, drop.forces, drop.positions, kernel));
    benchmark::ClobberMemory();
  }
  drop.report(state);
}
BENCHMARK(sharing)->Unit(benchmark::kMicrosecond);

}  // namespace
