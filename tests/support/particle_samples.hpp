#pragma once
// Small sets of particles for tests. A sample is indexed by global id; the rows of a set hold a choice of it.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop::test {

inline constexpr double spacing = 2.5e-5;                  // d, m
inline constexpr double smoothing_length = 1.2 * spacing;  // h, m
inline constexpr double reference_density = 1000.0;        // kg/m3

/// 0, 1, ..., count - 1.
inline std::vector<std::int32_t> first_ids(std::size_t count) {
  std::vector<std::int32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

/// Square lattice, column by column in x, from bottom to top in a column.
inline std::vector<Vector> lattice(int columns, int rows, double d) {
  std::vector<Vector> positions;
  for (int ix = 0; ix < columns; ++ix)
    for (int iy = 0; iy < rows; ++iy) positions.push_back({ix * d, iy * d});
  return positions;
}

/// Moves every coordinate by up to `amplitude`.
inline void perturb(std::vector<Vector>& positions, double amplitude, RandomNumbers& random) {
  for (Vector& p : positions) p += random.in_box({-amplitude, -amplitude}, {amplitude, amplitude});
}

struct FluidSample {
  Vector position, velocity;
  double density = reference_density;
  double mass = reference_density * spacing * spacing;
};

/// A perturbed lattice with holes (one particle in ten is missing), random velocities, densities and masses.
inline std::vector<FluidSample> random_fluid(int columns, int rows, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Vector> positions = lattice(columns, rows, spacing);
  perturb(positions, 0.25 * spacing, random);
  std::vector<FluidSample> sample;
  for (const Vector& p : positions) {
    if (random.between(0, 1) < 0.1) continue;
    sample.push_back({p, random.in_box({-1, -1}, {1, 1}), reference_density * random.between(0.98, 1.02),
                      reference_density * spacing * spacing * random.between(0.8, 1.2)});
  }
  return sample;
}

/// Rows: `owned` in the order given, then `ghosts`.
inline void fill(FluidParticles& fluid, std::span<const FluidSample> sample, std::span<const std::int32_t> owned,
                 std::span<const std::int32_t> ghosts = {}) {
  fluid.resize(owned.size() + ghosts.size());
  for (std::size_t row = 0; row < fluid.size(); ++row) {
    const std::int32_t id = row < owned.size() ? owned[row] : ghosts[row - owned.size()];
    const FluidSample& s = sample[static_cast<std::size_t>(id)];
    fluid.id[row] = id;
    fluid.position.set(row, s.position);
    fluid.velocity.set(row, s.velocity);
    fluid.density[row] = s.density;
    fluid.mass[row] = s.mass;
  }
  const auto first_ghost = static_cast<std::int32_t>(owned.size());
  fluid.owned = {{0, first_ghost}};
  fluid.ghosts.clear();
  if (!ghosts.empty()) fluid.ghosts = {{first_ghost, static_cast<std::int32_t>(fluid.size())}};
}

struct SolidSample {
  Vector position, velocity;
  double density = reference_density;
  double mass = reference_density * spacing * spacing;
  double tau_xx = 0, tau_yy = 0, tau_xy = 0;  // deviatoric stress, Pa
};

/// A perturbed lattice in lattice order with random velocities, densities, masses and stresses of either sign.
inline std::vector<SolidSample> random_solid(int columns, int rows, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Vector> positions = lattice(columns, rows, spacing);
  perturb(positions, 0.15 * spacing, random);
  std::vector<SolidSample> sample;
  for (const Vector& p : positions) {
    SolidSample s{p, random.in_box({-1, -1}, {1, 1})};
    s.density *= random.between(0.99, 1.01);
    s.mass *= random.between(0.9, 1.1);
    s.tau_xx = random.between(-1e6, 1e6);
    s.tau_yy = random.between(-1e6, 1e6);
    s.tau_xy = random.between(-1e6, 1e6);
    sample.push_back(s);
  }
  return sample;
}

enum class Presence : char { absent, owned, ghost };

/// Sets owned and ghost ranges of rows with the given presences (none absent).
inline void set_ranges(ParticleSet& particles, std::span<const Presence> rows) {
  particles.owned.clear();
  particles.ghosts.clear();
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first + 1;
    while (last < rows.size() && rows[last] == rows[first]) ++last;
    (rows[first] == Presence::owned ? particles.owned : particles.ghosts)
        .push_back({static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)});
    first = last;
  }
}

/// Rows in ascending id; `presence` has one entry per id of the sample.
inline void fill(SolidParticles& solid, std::span<const SolidSample> sample, std::span<const Presence> presence) {
  std::vector<Presence> rows;
  std::vector<std::size_t> ids;
  for (std::size_t id = 0; id < sample.size(); ++id) {
    if (presence[id] == Presence::absent) continue;
    rows.push_back(presence[id]);
    ids.push_back(id);
  }
  solid.resize(rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const SolidSample& s = sample[ids[row]];
    solid.id[row] = static_cast<std::int64_t>(ids[row]);
    solid.position.set(row, s.position);
    solid.velocity.set(row, s.velocity);
    solid.density[row] = s.density;
    solid.mass[row] = s.mass;
    solid.is_fixed[row] = 0.0;
    solid.deviatoric_stress.xx[row] = s.tau_xx;
    solid.deviatoric_stress.yy[row] = s.tau_yy;
    solid.deviatoric_stress.xy[row] = s.tau_xy;
  }
  set_ranges(solid, rows);
}

inline void fill(SolidParticles& solid, std::span<const SolidSample> sample) {
  fill(solid, sample, std::vector<Presence>(sample.size(), Presence::owned));
}

}  // namespace sphdrop::test
