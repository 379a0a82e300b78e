#pragma once
// Neighbour lists for particles in lattice order (solid): the neighbours of consecutive rows lie at the same few
// offsets.

#include <cstdint>
#include <vector>

#include "particles/particle_set.hpp"
#include "sph/pair_sharing.hpp"

namespace sphdrop {

/// For each block of eight consecutive rows the ascending union of the row offsets j - i of its particles' neighbours,
/// so that a neighbour of all eight is one contiguous load. Rows are sorted by global id, hence every particle sums in
/// ascending id. A row at an offset that is no neighbour is out of the kernel's reach and adds an exact zero, and so
/// does the particle itself (offset 0 may be among them).
struct OffsetNeighbours {
  struct Block {
    std::int32_t first_row = 0;
    std::int32_t first_offset = 0;
    std::int32_t offsets = 0;
    bool needs_ghosts = false;  ///< an owned row of the block has a ghost in its list
  };
  std::vector<Block> blocks;
  std::vector<std::int32_t> offsets;
  PairSharing sharing;     ///< entry by entry, as `offsets`
  std::int64_t pairs = 0;  ///< within reach, of owned rows

  /// Blocks that cover all owned rows of `particles`, whose rows must be sorted by id. `reach` in m.
  static OffsetNeighbours build(const ParticleSet& particles, const Column<double>& x, const Column<double>& y,
                                double reach);
  /// The same for all rows marked in `wanted`, ghosts among them.
  static OffsetNeighbours build(const ParticleSet& particles, const std::vector<char>& wanted, const Column<double>& x,
                                const Column<double>& y, double reach);
};

}  // namespace sphdrop
