#include "setup/droplet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particles/elementary_functions.hpp"
#include "setup/split_mix.hpp"

namespace sphdrop {

DropParticles round_drop_of_rings(double radius, double spacing, double density) {
  constexpr double pi = std::numbers::pi;
  // In fractions of a turn. Successive rings are turned by an irrational part of a turn, so that they never line up.
  constexpr double golden_angle = 0.3819660112501051;
  const int ring_count = std::max(1, static_cast<int>(std::floor(radius / spacing + 0.5)));
  const double ring_spacing = radius / ring_count;
  DropParticles drop;
  for (int k = 0; k < ring_count; ++k) {
    const int count = static_cast<int>(std::floor(pi * (2 * k + 1) + 0.5));
    const double annulus_area = pi * (2 * k + 1) * (ring_spacing * ring_spacing);
    const double ring_radius = (k + 0.5) * ring_spacing;
    for (int j = 0; j < count; ++j) {
      const double turns = static_cast<double>(j) / count + k * golden_angle;
      const SineCosine direction = sine_cosine(2.0 * pi * (turns - std::floor(turns)));
      drop.positions.push_back(ring_radius * Vector{direction.cosine, direction.sine});
      drop.masses.push_back(density * annulus_area / count);
    }
  }
  return drop;
}

DropParticles round_drop_of_lattice(double radius, double spacing, double density) {
  DropParticles drop;
  const int half_count = static_cast<int>(radius / spacing) + 1;
  for (int column = -half_count; column < half_count; ++column) {
    for (int row = -half_count; row < half_count; ++row) {
      const Vector position{(column + 0.5) * spacing, (row + 0.5) * spacing};
      if (squared_length(position) <= radius * radius) drop.positions.push_back(position);
    }
  }
  // A drop smaller than a cell is one particle.
  if (drop.positions.empty()) drop.positions.push_back({});
  const double total = density * std::numbers::pi * radius * radius;
  drop.masses.assign(drop.positions.size(), total / static_cast<double>(drop.positions.size()));
  return drop;
}

DropParticles elliptic_drop(double half_width, double half_height, double spacing, double density) {
  DropParticles drop;
  const int half_columns = static_cast<int>(half_width / spacing) + 1;
  const int half_rows = static_cast<int>(half_height / spacing) + 1;
  for (int column = -half_columns; column < half_columns; ++column) {
    for (int row = -half_rows; row < half_rows; ++row) {
      const Vector position{(column + 0.5) * spacing, (row + 0.5) * spacing};
      const Vector scaled{position.x / half_width, position.y / half_height};
      if (squared_length(scaled) <= 1.0) drop.positions.push_back(position);
    }
  }
  if (drop.positions.empty()) drop.positions.push_back({});
  const double total = density * std::numbers::pi * half_width * half_height;
  drop.masses.assign(drop.positions.size(), total / static_cast<double>(drop.positions.size()));
  return drop;
}

DropParticles square_drop(double side, double spacing, double density) {
  DropParticles drop;
  const int count = std::max(1, static_cast<int>(std::floor(side / spacing + 0.5)));
  const double cell = side / count;
  for (int column = 0; column < count; ++column) {
    for (int row = 0; row < count; ++row) {
      // Half-integers are exact, and so is the symmetry about the centre.
      drop.positions.push_back(cell * Vector{column + 0.5 - 0.5 * count, row + 0.5 - 0.5 * count});
      drop.masses.push_back(density * cell * cell);
    }
  }
  return drop;
}

void jitter_positions(std::vector<Vector>& positions, double amplitude, std::int64_t seed) {
  SplitMix64 random(static_cast<std::uint64_t>(seed));
  for (Vector& position : positions) {
    position.x += amplitude * random.next_symmetric();
    position.y += amplitude * random.next_symmetric();
  }
}

Vector oscillation_velocity(Vector from_centre, double amplitude, double decay_radius) {
  const double r = length(from_centre);
  if (r == 0.0) return {};  // the field's limit: it grows like x/r0
  const double x = from_centre.x;
  const double y = from_centre.y;
  const double r0 = decay_radius;
  const double factor = amplitude / r0 * exponential(-r / r0);
  return {factor * x * (1.0 - y * y / (r0 * r)), -factor * y * (1.0 - x * x / (r0 * r))};
}

}  // namespace sphdrop
