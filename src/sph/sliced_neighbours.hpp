#pragma once
// Neighbour lists for particles without order (liquid): eight a slice, one a lane.

#include <cstdint>
#include <vector>

#include "particles/particle_set.hpp"

namespace sphdrop {

/// Slices of eight consecutive owned rows. Entry k of a slice holds the k-th neighbour of each of its rows, in
/// ascending global id: the order in which a particle sums over its neighbours is a property of the particle, not of
/// the list. A shorter list is filled up with the set's padding row, which is far away. The particle itself is not in
/// its list.
struct SlicedNeighbours {
  struct Slice {
    std::int32_t first_row = 0;
    std::int32_t rows = 0;  ///< 1 to 8: the last slice of a range may be short
    std::int32_t first_entry = 0;
    std::int32_t entries = 0;
  };
  std::vector<Slice> slices;
  std::vector<std::int32_t> neighbours;  ///< [entry][lane]
  std::int64_t pairs = 0;                ///< without padding

  /// Slices over the owned rows [begin, end) of `particles`; the positions of all rows must be present. `reach` in m.
  static SlicedNeighbours build(const ParticleSet& particles, const Column<double>& x, const Column<double>& y,
                                RowRange rows, double reach);
};

}  // namespace sphdrop
