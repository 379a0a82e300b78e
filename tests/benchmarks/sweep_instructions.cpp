// Runs every sweep of a step a few times over small bodies. What each costs is counted in instructions by
// instruction_counts.py: unlike times they are the same on every machine, as this is compiled for a fixed instruction
// set whatever the rest is compiled for.

#include <cstdint>
#include <cstdio>
#include <numeric>
#include <vector>

#include "contact/contact_solver.hpp"
#include "fluid/density_correction.hpp"
#include "fluid/fluid_sweep.hpp"
#include "solid/cells/cell_sweep.hpp"
#include "solid/hypoelastic/hypoelastic_sweep.hpp"
#include "solid/total_lagrangian/total_lagrangian_sweep.hpp"
#include "sph/equation_of_state.hpp"
#include "surface_tension/force_sharing.hpp"
#include "time_integration/leapfrog.hpp"

namespace {

using namespace sphdrop;

constexpr double spacing = 2.5e-5, smoothing_length = 1.2 * spacing, density = 1000.0;
constexpr double reach = 2 * smoothing_length + 0.3 * spacing;
constexpr double step = 5e-9;
constexpr int rows = 10, columns = 60, repetitions = 5;
constexpr CubicSpline kernel(smoothing_length);

std::vector<Vector> lattice() {
  std::vector<Vector> positions;
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) positions.push_back({column * spacing, row * spacing});
  return positions;
}

/// At rest but for a velocity that bends it, of particles that stand on the lattice.
template <class Set>
void fill(Set& set) {
  const std::vector<Vector> positions = lattice();
  set.resize(positions.size());
  set.owned = {{0, static_cast<std::int32_t>(positions.size())}};
  for (std::size_t k = 0; k < positions.size(); ++k) {
    set.id[k] = static_cast<std::int64_t>(k);
    set.position.set(k, positions[k]);
    set.mass[k] = density * spacing * spacing;
    const double x = positions[k].x / (columns * spacing);
    set.staggered_velocity.set(k, {0.0, x * x});
    set.staggered_density[k] = density * (1.0 + 1e-3 * x);
  }
}

const ElasticMaterial material{density, 300e6, 0.3};

bool hypoelastic() {
  SolidParticles solid;
  fill(solid);
  const OffsetNeighbours list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, reach);
  const HypoelasticSweep sweep(
      {{kernel, {2.0, 0.0, material.sound_speed(), smoothing_length}, 1.0 / kernel.value(spacing)},
       material,
       1.0 / 3,
       0.2});
  bool is_sound = true;
  for (int k = 0; k < repetitions; ++k) {
    predict(solid, step);
    sweep.update_stress(solid, solid.owned);
    sweep.apply(solid, list, HypoelasticSweep::Blocks::without_ghosts);
    is_sound = !kick_and_drift(solid, {step, step}, 10.0).beyond_limit && is_sound;
  }
  return is_sound;
}

bool total_lagrangian() {
  SolidParticles solid;
  fill(solid);
  solid.reference_position.take(solid.position);
  TotalLagrangianSweep sweep(TotalLagrangianMaterial<StVenantKirchhoff>{{LameModuli(material)}, material.density, 0.0},
                             kernel);
  sweep.relist(solid);
  bool is_sound = true;
  for (int k = 0; k < repetitions; ++k) {
    predict_velocity(solid, step);
    sweep.deform(solid, TotalLagrangianSweep::Blocks::without_ghosts);
    sweep.accelerate(solid);
    is_sound = !kick_and_drift_velocity(solid, {step, step}, 10.0, false).beyond_limit && is_sound;
  }
  return is_sound;
}

bool cells() {
  SolidParticles solid;
  fill(solid);
  const std::vector<Vector> positions = lattice();
  CellMaterial<StVenantKirchhoff> cell;
  cell.law.moduli = LameModuli(material);
  cell.bending_modulus = 300e6 / 0.91;
  cell.spacing = spacing;
  cell.damping_time = 0;
  CellSweep sweep(cell);
  sweep.set_mesh(CellMesh(solid, LatticeCells(positions, std::vector<char>(positions.size(), 0), spacing, false), 0));
  bool is_sound = true;
  for (int k = 0; k < repetitions; ++k) {
    sweep.sweep(solid, CellSweep::Cells::without_ghosts);
    sweep.accelerate(solid);
    is_sound = !kick_and_drift_velocity(solid, {step, step}, 10.0, false).beyond_limit && is_sound;
  }
  return is_sound;
}

bool liquid() {
  FluidParticles fluid;
  fill(fluid);
  const SlicedNeighbours list =
      SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, fluid.owned[0], reach);
  FluidSweep sweep{FluidPairParameters<>{kernel, {0.1, 0.0, 50.0, smoothing_length}}};
  sweep.resize(fluid);
  std::vector<double> corrected(fluid.size() + column_padding);
  bool is_sound = true;
  for (int k = 0; k < repetitions; ++k) {
    predict(fluid, step);
    fluid.for_each_owned(
        [&](std::size_t row) { fluid.pressure[row] = equation_of_state_pressure(fluid.density[row], 50.0, density); });
    sweep.pack(fluid, fluid.owned);
    sweep.apply(fluid, list);
    moving_least_squares_densities(fluid, list, kernel, spacing, corrected);
    is_sound = !kick_and_drift(fluid, {step, step}, 10.0).beyond_limit && is_sound;
  }
  return is_sound;
}

// The lattice's lowest row is the surface that forces act on, and as much of it touches a boundary.
bool interfaces() {
  std::vector<double> x, y, mass, acceleration_x, acceleration_y, vertex_x, vertex_y;
  for (const Vector p : lattice()) {
    x.push_back(p.x);
    y.push_back(p.y);
    mass.push_back(density * spacing * spacing);
  }
  acceleration_x.resize(x.size());
  acceleration_y.resize(x.size());
  std::vector<Vector> points, forces;
  std::vector<std::int32_t> line;
  for (std::int32_t k = 0; k < columns; ++k) {
    points.push_back({k * spacing, -0.5 * spacing});
    forces.push_back({0.0, 1e-3});
    line.push_back(k);
    vertex_x.push_back((k - 0.3) * spacing);
    vertex_y.push_back(-0.95 * spacing);
  }
  ForceSharing sharing;
  std::vector<std::int32_t> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Vector> places = lattice();
  sharing.rebuild(points, places, order, reach);
  places.push_back(ForceSharing::far_away);
  ContactSolver solver;
  const std::vector<Segment> segments = segments_of_polylines(std::vector<std::vector<std::int32_t>>{line});
  solver.rebuild(x, y, vertex_x, vertex_y, segments, 1.3 * spacing);
  std::vector<double> force_x(vertex_x.size()), force_y(vertex_x.size());
  bool is_sound = true;
  for (int k = 0; k < repetitions; ++k) {
    is_sound = sharing.share(points, forces, places, kernel).size() == x.size() && is_sound;
    is_sound = sharing.points_without_particles() == 0 && is_sound;
    const ContactSummary contact = solver.apply({x, y, mass, acceleration_x, acceleration_y},
                                                {vertex_x, vertex_y, force_x, force_y}, {1e12, spacing, 0.5});
    is_sound = contact.count > columns / 2 && is_sound;
  }
  return is_sound;
}

}  // namespace

int main() {
  const bool is_sound = hypoelastic() && total_lagrangian() && cells() && liquid() && interfaces();
  if (!is_sound) std::puts("sweep_instructions: the bodies do not do what is to be counted");
  return is_sound ? 0 : 1;
}
