#pragma once
// Which particles live here, which are here as ghosts, and who is whose neighbour.

#include <span>

#include "config/case.hpp"
#include "decomposition/domain_partition.hpp"
#include "decomposition/exchange_plan.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"
#include "sph/offset_neighbours.hpp"
#include "sph/sliced_neighbours.hpp"

namespace sphdrop {

/// Message tags: one range for every plan, as several are in flight at a time.
namespace tags {
inline constexpr int migration = 100, fluid_halo = 110, solid_halo = 120, wide_halo = 130, surface = 140,
                     contact_fluid = 150, contact_solid = 160;
}

/// Lengths of the lists and halos.
struct InteractionRange {
  double support = 0;  ///< 2h, m
  double skin = 0;     ///< lists reach 2h + skin, m; they hold until a particle has moved by half of it

  double list_reach() const { return support + skin; }
  double largest_displacement() const { return 0.5 * skin; }
};

/// Edge of the cells that are dealt out, m: the lists' reach, or a multiple of it where there are so many particles
/// that each rank still has input.parallel.cells_per_process.
double partition_cell_edge(const Case& input, const InteractionRange& range, bool solid_is_total_lagrangian,
                           std::size_t drop_particles, std::size_t solid_particles, int ranks);

/// The particles' distribution over ranks, remade by redistribute() and used by every step in between.
class Distribution {
 public:
  /// The particles of a drop that is rigid have no neighbours and no ghosts. A solid that is total-Lagrangian is dealt
  /// out by its places in the undeformed body: its particles stay where they are while it moves, and its ghosts are
  /// those within `solid_reach`, m. `cell_edge`: of partition_cell_edge().
  Distribution(const Communicator& communicator, const InteractionRange& range, double cell_edge,
               double imbalance_threshold, bool drop_is_rigid, bool solid_is_total_lagrangian, double solid_reach);

  /// Collective. Moves every particle to the rank that owns its place (repartitioning if the loads ask for it, or
  /// `force`), makes ghosts of what other ranks hold within reach, and lists the neighbours. Needs the state columns of
  /// owned rows; afterwards those, the constant columns and the positions of ghosts are good, everything else is not.
  /// Returns false if the solid is as it was, rows, ghosts and all, as a total-Lagrangian one mostly is.
  /// `surface_rows`: the liquid's rows of the surface's nodes, one for each, which are work besides.
  bool redistribute(FluidParticles& fluid, SolidParticles& solid, std::span<const std::int32_t> surface_rows,
                    bool force);

  ExchangePlan& fluid_halo() { return fluid_halo_; }
  ExchangePlan& solid_halo() { return solid_halo_; }
  const ExchangePlan& fluid_halo() const { return fluid_halo_; }
  const ExchangePlan& solid_halo() const { return solid_halo_; }
  /// Positions within 4h + skin, which surface detection looks at: what arrives is stored behind the owned rows.
  ExchangePlan& wide_halo() { return wide_halo_; }

  /// Owned liquid rows: those without a ghost in reach, swept while the halo is under way, and the others.
  const SlicedNeighbours& inner_fluid() const { return inner_fluid_; }
  const SlicedNeighbours& border_fluid() const { return border_fluid_; }
  const OffsetNeighbours& solid() const { return solid_; }
  const InteractionRange& range() const { return range_; }
  /// Of the cells that are dealt out, m.
  double cell_edge() const { return partition_.cell_size(); }
  const PartitionQuality& quality() const { return partition_.quality(); }
  /// Appends the ranks other than this one that own something within `reach` (m) of a place, as particles were dealt
  /// out: by the places of the liquid and of the solid, undeformed if it is total-Lagrangian.
  void other_ranks_within(Vector place, double reach, std::vector<int>& ranks) const {
    partition_.other_ranks_within(place.x, place.y, reach, ranks);
  }

 private:
  bool solid_changes_ranks(std::span<const int> destination) const;
  /// Rows near other ranks last; within the two groups by cell, so that neighbours are near in memory. Returns how many
  /// are not near others.
  std::int32_t sort_fluid(FluidParticles& fluid) const;
  /// Returns how many rows need no ghosts.
  std::int32_t make_fluid_ghosts(FluidParticles& fluid);
  void list_fluid(const FluidParticles& fluid, std::int32_t inner_rows);
  void make_solid_ghosts(SolidParticles& solid);

  const Communicator& communicator_;
  InteractionRange range_;
  bool drop_is_rigid_, solid_is_total_lagrangian_;
  bool has_distributed_solid_ = false;
  double solid_reach_;
  DomainPartition partition_;
  ExchangePlan fluid_halo_, solid_halo_, wide_halo_;
  SlicedNeighbours inner_fluid_, border_fluid_;
  OffsetNeighbours solid_;
};

}  // namespace sphdrop
