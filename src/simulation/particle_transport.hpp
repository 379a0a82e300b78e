#pragma once
// Particle sets on the move: which columns travel follows from the roles of their quantities.

#include <span>

#include "decomposition/domain_partition.hpp"
#include "decomposition/exchange_plan.hpp"
#include "particles/particle_set.hpp"

namespace sphdrop {

/// Collective. Sends every owned row (`destination`: shape [owned rows], ascending row) with its id and state to its
/// new owner. Afterwards all rows are owned and in no particular order; ghosts are gone.
void migrate(const Communicator& communicator, ParticleSet& particles, std::span<const int> destination, int tag);

/// new row k = old row order[k], for ids, state and constants; all rows must be owned.
void reorder(ParticleSet& particles, std::span<const std::int32_t> order);

/// Collective. The plan that sends every owned row to the ranks that own a cell within `reach` (m) of it, to be stored
/// behind the owned rows, which are the first ones.
ExchangePlan halo_plan(const Communicator& communicator, const ParticleSet& particles, const VectorField& position,
                       const DomainPartition& partition, double reach, int tag);

/// Collective. halo_plan(), with room made for the ghosts and their ids, constants and positions filled in.
ExchangePlan make_halo(const Communicator& communicator, ParticleSet& particles, VectorField& position,
                       const DomainPartition& partition, double reach, int tag);

/// Puts owned rows and ghosts together in ascending id, and renumbers the plan to match.
void sort_by_id(ParticleSet& particles, ExchangePlan& halo);

/// Starts, or ends, sending the step's ghosted columns through the halo. Columns are those of columns_with(ghosted).
void start_exchange(ExchangePlan& plan, std::span<Column<double>* const> columns);
void finish_exchange(ExchangePlan& plan, std::span<Column<double>* const> columns);

}  // namespace sphdrop
