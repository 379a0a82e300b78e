#include "sph/pair_sharing.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "particles/pack.hpp"
#include "sph/offset_neighbours.hpp"

namespace sphdrop {

namespace {

using Block = OffsetNeighbours::Block;
constexpr std::int32_t none = PairSharing::none;

/// The entries of a list, found by block of rows and offset.
class Entries {
 public:
  explicit Entries(const OffsetNeighbours& list) : list_(list) {
    for (std::size_t b = 0; b < list.blocks.size(); ++b) {
      const auto place = static_cast<std::size_t>(list.blocks[b].first_row / block_size);
      if (block_at_.size() <= place) block_at_.resize(place + 1, none);
      block_at_[place] = static_cast<std::int32_t>(b);
    }
  }

  std::span<const std::int32_t> offsets(const Block& block) const {
    return std::span(list_.offsets).subspan(block.first_offset, block.offsets);
  }

  /// The entry `offset` of the block that holds `row` and is swept with `other`, or none.
  std::int32_t find(std::int32_t row, std::int32_t offset, const Block& other) const {
    const auto place = static_cast<std::size_t>(row / block_size);
    if (place >= block_at_.size() || block_at_[place] == none) return none;
    const Block& block = list_.blocks[static_cast<std::size_t>(block_at_[place])];
    if (block.needs_ghosts != other.needs_ghosts) return none;
    const auto mine = offsets(block);
    const auto found = std::lower_bound(mine.begin(), mine.end(), offset);
    if (found == mine.end() || *found != offset) return none;
    return block.first_offset + static_cast<std::int32_t>(found - mine.begin());
  }

  /// The entries that evaluate the pairs of `block` at -offset: rows of one block or of two. None if there is not all.
  std::array<std::int32_t, 2> evaluated_for(const Block& block, std::int32_t offset) const {
    const std::int32_t first = block.first_row - offset;
    if (first < 0 || offset + block_size > PairSharing::row_choices.back()) return {none, none};
    const std::int32_t low = find(first, offset, block);
    const std::int32_t high = find(first + block_size - 1, offset, block);
    if (low == none || high == none) return {none, none};
    return {low, high};
  }

 private:
  const OffsetNeighbours& list_;
  std::vector<std::int32_t> block_at_;  // by rows
};

}  // namespace

PairSharing PairSharing::plan(const OffsetNeighbours& list) {
  PairSharing plan;
  plan.slots.assign(list.offsets.size(), none);
  const Entries entries(list);
  const auto for_each_negative = [&](auto&& f) {
    for (const Block& block : list.blocks) {
      const auto offsets = entries.offsets(block);
      for (std::size_t k = 0; k < offsets.size() && offsets[k] < 0; ++k)
        f(static_cast<std::size_t>(block.first_offset) + k, -offsets[k], entries.evaluated_for(block, -offsets[k]));
    }
  };

  std::vector<char> is_wanted(list.offsets.size(), 0);
  std::int32_t furthest = 0;
  for_each_negative([&](std::size_t, std::int32_t offset, std::array<std::int32_t, 2> sources) {
    if (sources[0] == none) return;
    for (const std::int32_t source : sources) is_wanted[static_cast<std::size_t>(source)] = 1;
    furthest = std::max(furthest, offset);
  });
  // What is asked for must not be where the block swept now has written.
  plan.rows = *std::find_if(row_choices.begin(), row_choices.end(),
                            [&](std::int32_t choice) { return furthest + block_size <= choice; });

  // A slot goes from one offset to another when nobody can ask for its rows any more.
  struct Slot {
    std::int32_t offset = 0, last_row = 0;
  };
  std::vector<Slot> slots;
  for (const Block& block : list.blocks) {
    plan.first_kept.push_back(static_cast<std::int32_t>(plan.kept.size()));
    const auto offsets = entries.offsets(block);
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const std::size_t entry = static_cast<std::size_t>(block.first_offset) + k;
      if (!is_wanted[entry]) continue;
      auto slot = std::find_if(slots.begin(), slots.end(), [&](const Slot& s) { return s.offset == offsets[k]; });
      if (slot == slots.end())
        slot = std::find_if(slots.begin(), slots.end(),
                            [&](const Slot& s) { return s.last_row + plan.rows < block.first_row; });
      if (slot == slots.end()) {
        if (slots.size() == most_slots) continue;
        slot = slots.insert(slots.end(), Slot{});
      }
      *slot = {offsets[k], block.first_row};
      plan.slots[entry] = static_cast<std::int32_t>(slot - slots.begin());
      plan.kept.push_back({offsets[k], plan.slots[entry]});
    }
  }
  plan.first_kept.push_back(static_cast<std::int32_t>(plan.kept.size()));
  plan.slot_count = static_cast<std::int32_t>(slots.size());

  for_each_negative([&](std::size_t entry, std::int32_t, std::array<std::int32_t, 2> sources) {
    if (sources[0] == none) return;
    const std::int32_t low = plan.slots[static_cast<std::size_t>(sources[0])];
    if (low == plan.slots[static_cast<std::size_t>(sources[1])]) plan.slots[entry] = low;
  });
  return plan;
}

}  // namespace sphdrop
