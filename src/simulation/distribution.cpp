#include "simulation/distribution.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "simulation/particle_transport.hpp"

namespace sphdrop {

namespace {

// What a particle costs in a step, relative to others, by measured times (tests/benchmarks/README.md): a rigid drop's
// particles have no pair sums. They are numbers of the program, not of the run: times of a run would follow whatever
// else its machine does.
struct Loads {
  std::int32_t drop, solid;
  std::int32_t surface_node = 0;  // besides, with what it takes to find the surface now and then
};
constexpr Loads loads_with_liquid{11, 10, 7}, loads_with_rigid_drop{1, 20};
// Cells are far cheaper.
constexpr Loads cells_with_liquid{8, 1, 5}, cells_with_rigid_drop{1, 2};

Loads loads_of(bool drop_is_rigid, bool solid_is_total_lagrangian) {
  return solid_is_total_lagrangian ? (drop_is_rigid ? cells_with_rigid_drop : cells_with_liquid)
                                   : (drop_is_rigid ? loads_with_rigid_drop : loads_with_liquid);
}

}  // namespace

double partition_cell_edge(const Case& input, const InteractionRange& range, bool solid_is_total_lagrangian,
                           std::size_t drop_particles, std::size_t solid_particles, int ranks) {
  // Counted as so many of the costliest: then no cell is more than its part of a rank's share, whatever is in it.
  const Loads loads = loads_of(input.drop.is_rigid(), solid_is_total_lagrangian);
  const double load =
      loads.drop * static_cast<double>(drop_particles) + loads.solid * static_cast<double>(solid_particles);
  const double spacings = range.list_reach() / input.resolution.spacing;
  const double cells = load / std::max(loads.drop, loads.solid) / (spacings * spacings);
  return cells_edge(cells, ranks, input.parallel.cells_per_process, range.list_reach());
}

Distribution::Distribution(const Communicator& communicator, const InteractionRange& range, double cell_edge,
                           double imbalance_threshold, bool drop_is_rigid, bool solid_is_total_lagrangian,
                           double solid_reach)
    : communicator_(communicator),
      range_(range),
      drop_is_rigid_(drop_is_rigid),
      solid_is_total_lagrangian_(solid_is_total_lagrangian),
      solid_reach_(solid_reach),
      partition_(communicator, cell_edge, imbalance_threshold) {}

bool Distribution::redistribute(FluidParticles& fluid, SolidParticles& solid,
                                std::span<const std::int32_t> surface_rows, bool force) {
  std::vector<double> x, y;
  std::vector<std::int32_t> load;
  const auto collect = [&](const ParticleSet& set, const VectorField& place, std::int32_t cost) {
    set.for_each_owned([&](std::size_t row) {
      x.push_back(place.x[row]);
      y.push_back(place.y[row]);
      load.push_back(cost);
    });
  };
  const Loads loads = loads_of(drop_is_rigid_, solid_is_total_lagrangian_);
  collect(fluid, fluid.position, loads.drop);
  collect(solid, solid_is_total_lagrangian_ ? solid.reference_position : solid.position, loads.solid);
  // The liquid's come first, row after row.
  for (const std::int32_t row : surface_rows) load[static_cast<std::size_t>(row)] += loads.surface_node;
  partition_.update(x, y, load, force);

  std::vector<int> destination(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) destination[k] = partition_.owner_of(x[k], y[k]);
  for (auto* places : {&x, &y}) std::vector<double>().swap(*places);
  std::vector<std::int32_t>().swap(load);
  const std::size_t fluid_rows = fluid.owned_count();
  migrate(communicator_, fluid, std::span(destination).first(fluid_rows), tags::migration);
  const std::span<const int> solid_destination = std::span(destination).subspan(fluid_rows);
  const bool solid_changes = solid_changes_ranks(solid_destination);
  if (solid_changes) migrate(communicator_, solid, solid_destination, tags::migration + 1);
  // Ghosts of both before lists of either: a rank without liquid would wait for the other ranks' lists of it.
  std::int32_t inner_fluid_rows = 0;
  if (!drop_is_rigid_) inner_fluid_rows = make_fluid_ghosts(fluid);
  fluid.list_position.take(fluid.position);
  if (solid_changes) make_solid_ghosts(solid);
  solid.list_position.take(solid.position);
  if (!drop_is_rigid_) list_fluid(fluid, inner_fluid_rows);
  if (solid_changes && !solid_is_total_lagrangian_)
    solid_ = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, solid_reach_);
  has_distributed_solid_ = true;
  return solid_changes;
}

// One that keeps its neighbours need not move unless the partition does.
bool Distribution::solid_changes_ranks(std::span<const int> destination) const {
  if (!solid_is_total_lagrangian_ || !has_distributed_solid_) return true;
  const bool leaves =
      std::any_of(destination.begin(), destination.end(), [&](int rank) { return rank != communicator_.rank(); });
  return communicator_.max(static_cast<std::int64_t>(leaves ? 1 : 0)) > 0;
}

std::int32_t Distribution::sort_fluid(FluidParticles& fluid) const {
  const std::size_t owned = fluid.size();
  struct Key {
    bool border;
    std::int64_t cell_y, cell_x, id;
    std::int32_t row;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys(owned);
  std::vector<int> ranks;
  const double inverse_cell = 1.0 / range_.list_reach();
  for (std::size_t row = 0; row < owned; ++row) {
    const Vector p = fluid.position.at(row);
    ranks.clear();
    partition_.other_ranks_within(p.x, p.y, range_.list_reach(), ranks);
    keys[row] = {!ranks.empty(), static_cast<std::int64_t>(std::floor(p.y * inverse_cell)),
                 static_cast<std::int64_t>(std::floor(p.x * inverse_cell)), fluid.id[row],
                 static_cast<std::int32_t>(row)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(owned);
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& key) { return key.row; });
  reorder(fluid, order);
  return static_cast<std::int32_t>(std::find_if(keys.begin(), keys.end(), [](const Key& key) { return key.border; }) -
                                   keys.begin());
}

std::int32_t Distribution::make_fluid_ghosts(FluidParticles& fluid) {
  // The old lists go first: old and new together would be the most memory that a run takes.
  inner_fluid_ = {};
  border_fluid_ = {};
  const std::int32_t inner = sort_fluid(fluid);
  fluid_halo_ = make_halo(communicator_, fluid, fluid.position, partition_, range_.list_reach(), tags::fluid_halo);
  // The halo of detection reaches the circles that overlap a particle's own, 4h away.
  wide_halo_ =
      halo_plan(communicator_, fluid, fluid.position, partition_, 2.0 * range_.support + range_.skin, tags::wide_halo);
  return inner;
}

void Distribution::list_fluid(const FluidParticles& fluid, std::int32_t inner_rows) {
  const auto end = static_cast<std::int32_t>(fluid.owned_count());
  const VectorField& place = fluid.position;
  inner_fluid_ = SlicedNeighbours::build(fluid, place.x, place.y, {0, inner_rows}, range_.list_reach());
  border_fluid_ = SlicedNeighbours::build(fluid, place.x, place.y, {inner_rows, end}, range_.list_reach());
}

void Distribution::make_solid_ghosts(SolidParticles& solid) {
  VectorField& place = solid_is_total_lagrangian_ ? solid.reference_position : solid.position;
  solid_halo_ = make_halo(communicator_, solid, place, partition_, solid_reach_, tags::solid_halo);
  sort_by_id(solid, solid_halo_);
}

}  // namespace sphdrop
