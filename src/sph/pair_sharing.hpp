#pragma once
// Which pairs of an offset list need to be evaluated once only, for both their particles.

#include <array>
#include <cstdint>
#include <vector>

namespace sphdrop {

struct OffsetNeighbours;

/// A pair stands twice in a list: at the offset o in its lower row's block, and at -o in its upper row's. As blocks are
/// swept in ascending order, what the lower one has evaluated can be kept until the upper one needs it, in a slot of
/// its offset that holds as many of the last rows as any offset reaches back. Every particle still sums in ascending
/// order.
struct PairSharing {
  static constexpr std::int32_t none = -1;
  /// More slots, or offsets further back, would not stay in a core's cache; such pairs are evaluated twice.
  static constexpr std::int32_t most_slots = 24;
  /// How many rows a slot may hold: the least that serve are taken.
  static constexpr std::array<std::int32_t, 3> row_choices{32, 64, 256};

  struct Kept {
    std::int32_t offset, slot;
  };
  std::vector<std::int32_t> slots;       ///< of each entry of the list, or none
  std::vector<Kept> kept;                ///< what the blocks evaluate for others and themselves, block by block
  std::vector<std::int32_t> first_kept;  ///< of each block, and the end of the last
  std::int32_t slot_count = 0;
  std::int32_t rows = row_choices.front();  ///< that a slot holds

  /// For sweeps over the blocks of `list` that need ghosts, and over those that do not, each in ascending order.
  static PairSharing plan(const OffsetNeighbours& list);
};

}  // namespace sphdrop
