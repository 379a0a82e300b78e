#include "setup/given_drop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "setup/nearest_neighbour.hpp"
#include "setup/setup_error.hpp"
#include "sph/cell_grid.hpp"

namespace sphdrop {
namespace {

std::vector<Vector> positions_of(const GivenParticles& given) {
  std::vector<Vector> positions;
  for (std::size_t k = 0; k < given.size(); ++k) positions.push_back({given.x[k], given.y[k]});
  return positions;
}

// A lattice of triangles with a particle for each spacing^2 has 1.07; particles in disorder, as after a run, 0.85.
void refuse_other_spacing(const GivenParticles& given, const NearestNeighbours& neighbours, double spacing) {
  constexpr double least = 0.75, most = 1.25;
  const double median = median_distance(neighbours), ratio = median / spacing;
  if (ratio >= least && ratio <= most) return;
  const bool is_milli = ratio > 1000 * least && ratio < 1000 * most;
  const bool is_micro = ratio > 1e6 * least && ratio < 1e6 * most;
  const std::string advice =
      is_milli || is_micro
          ? fmt::format("are its lengths in {0}? Then say so in its first line: x [{0}], y [{0}]",
                        is_milli ? "mm" : "um")
          : fmt::format("give particles at the spacing of the run, or take resolution.spacing = {:.4g} m", median);
  throw SetupError(fmt::format(
      "the particles of {} stand {:.4g} m apart (the median of the distances to the nearest one), which does "
      "not fit resolution.spacing = {:g} m: {}",
      given.file, median, spacing, advice));
}

void refuse_twins(const GivenParticles& given, const NearestNeighbours& neighbours, double spacing) {
  const double nearest_allowed = 0.5 * spacing;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (neighbours.distance[k] >= nearest_allowed) continue;
    const auto twin = static_cast<std::size_t>(neighbours.index[k]);
    if (twin > k) continue;  // told at the later one
    const std::string place = given.place_of(twin).substr(given.file.size() + 1);
    throw SetupError(
        fmt::format("{}: the particle at x = {:.6g} m, y = {:.6g} m is only {:.3g} m from that of {} {}; particles "
                    "must be at least "
                    "half of resolution.spacing apart, {:g} m",
                    given.place_of(k), given.x[k], given.y[k], neighbours.distance[k],
                    given.lines.empty() ? "" : "line", place, nearest_allowed));
  }
}

void refuse_other_masses(const GivenParticles& given, double density, double spacing) {
  constexpr double least = 0.5, most = 2;
  const double expected = density * spacing * spacing;
  for (std::size_t k = 0; k < given.mass.size(); ++k)
    if (given.mass[k] < least * expected || given.mass[k] > most * expected)
      throw SetupError(
          fmt::format("{}: a mass of {:g} kg/m does not fit particles {:g} m apart of {:g} kg/m3, which have {:.4g} "
                      "kg/m; leave the "
                      "masses out and they get that",
                      given.place_of(k), given.mass[k], spacing, density, expected));
}

/// Which piece each particle belongs to, by its first particle: those within `reach` of each other are of one.
std::vector<std::size_t> pieces_of(const std::vector<Vector>& positions, const GivenParticles& given, double reach) {
  std::vector<std::size_t> parent(positions.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root_of = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  const CellGrid grid(given.x, given.y, reach);
  for (std::size_t k = 0; k < positions.size(); ++k)
    grid.for_each_near(positions[k], [&](std::int32_t near) {
      const auto j = static_cast<std::size_t>(near);
      if (j >= k || squared_length(positions[k] - positions[j]) >= reach * reach) return;
      const std::size_t a = root_of(k), b = root_of(j);
      parent[std::max(a, b)] = std::min(a, b);
    });
  for (std::size_t k = 0; k < positions.size(); ++k) parent[k] = root_of(k);
  return parent;
}

}  // namespace

Drop drop_of_file(const Case& input) {
  if (!input.drop.given) throw SetupError(fmt::format("{} has not been read", input.drop.particles_file));
  const GivenParticles& given = *input.drop.given.particles;
  const double d = input.resolution.spacing;
  const double density = input.drop.is_rigid() ? input.drop.density : input.fluid.density;
  std::vector<Vector> positions = positions_of(given);
  const NearestNeighbours neighbours = nearest_neighbours(positions);
  refuse_other_spacing(given, neighbours, d);
  refuse_twins(given, neighbours, d);
  refuse_other_masses(given, density, d);

  const Point centre = given.centre();
  for (Vector& position : positions) position -= {centre.x, centre.y};
  std::vector<Vector> velocities;
  for (std::size_t k = 0; k < given.velocity_x.size(); ++k)
    velocities.push_back({given.velocity_x[k], given.velocity_y[k]});
  std::vector<double> masses = given.mass;
  if (masses.empty()) {
    const double radius = 0.5 * input.drop.diameter;
    const double total = density * std::numbers::pi * radius * radius;
    masses.assign(given.size(), total / static_cast<double>(given.size()));
  }
  Drop drop(ListedParticles(std::move(positions), std::move(masses)));
  drop.set_velocities(std::move(velocities));
  return drop;
}

std::string doubt_of_file(const Case& input) {
  const GivenParticles& given = *input.drop.given.particles;
  const double reach = 2.0 * input.resolution.smoothing_ratio * input.resolution.spacing;
  const std::vector<std::size_t> pieces = pieces_of(positions_of(given), given, reach);
  std::size_t count = 0, second = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k] != k) continue;
    if (++count == 2) second = k;
  }
  if (count < 2) return "";
  return fmt::format(
      "{}: here begins another piece: the particles of {} are in {} pieces, farther apart than they feel each other "
      "({:.4g} m)",
      given.place_of(second), given.file, count, reach);
}

}  // namespace sphdrop
