#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "particles/pack.hpp"
#include "particles/solid_particles.hpp"
#include "sph/offset_neighbours.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::Presence;

struct Counts {
  std::int64_t asked = 0;      // entries at negative offsets, but those that reach beyond the first row
  std::int64_t answered = 0;   // of which what was kept serves
  std::int64_t evaluated = 0;  // entries whose pairs are computed
};

/// Goes through a plan as a sweep does, with rings that hold names in the place of numbers: whoever asks must find the
/// pair that was meant, of this sweep.
Counts expect_that_what_is_asked_for_is_there(const std::vector<Vector>& positions, const std::vector<Presence>& rows,
                                              double reach) {
  SolidParticles solid;
  solid.resize(positions.size());
  for (std::size_t row = 0; row < positions.size(); ++row) {
    solid.id[row] = static_cast<std::int64_t>(row);
    solid.position.set(row, positions[row]);
  }
  test::set_ranges(solid, rows);
  const OffsetNeighbours list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, reach);
  const PairSharing& plan = list.sharing;
  EXPECT_EQ(plan.slots.size(), list.offsets.size());
  EXPECT_EQ(plan.first_kept.size(), list.blocks.size() + 1);
  EXPECT_LE(plan.slot_count, PairSharing::most_slots);

  Counts counts;
  for (const bool with_ghosts : {false, true}) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, std::int32_t>> ring;  // row, offset
    for (std::size_t b = 0; b < list.blocks.size(); ++b) {
      const OffsetNeighbours::Block& block = list.blocks[b];
      if (block.needs_ghosts != with_ghosts) continue;
      for (std::int32_t k = plan.first_kept[b]; k < plan.first_kept[b + 1]; ++k) {
        const PairSharing::Kept& kept = plan.kept[static_cast<std::size_t>(k)];
        EXPECT_GT(kept.offset, 0);
        EXPECT_LT(kept.slot, plan.slot_count);
        for (std::int32_t row = block.first_row; row < block.first_row + block_size; ++row)
          ring[{kept.slot, row % plan.rows}] = {row, kept.offset};
        ++counts.evaluated;
      }
      for (std::int32_t k = 0; k < block.offsets; ++k) {
        const auto entry = static_cast<std::size_t>(block.first_offset + k);
        const std::int32_t offset = list.offsets[entry], slot = plan.slots[entry];
        if (offset < 0 && block.first_row + offset >= 0) ++counts.asked;
        if (slot == PairSharing::none) {
          ++counts.evaluated;
          continue;
        }
        if (offset < 0) ++counts.answered;
        for (std::int32_t row = block.first_row; row < block.first_row + block_size; ++row) {
          const std::int32_t lower = std::min(row, row + offset);
          const auto expected = std::pair(lower, std::abs(offset));
          EXPECT_EQ((ring[{slot, lower % plan.rows}]), expected) << "row " << row << ", offset " << offset;
        }
      }
    }
  }
  return counts;
}

std::vector<Presence> all_owned(std::size_t rows) {
  return std::vector<Presence>(rows, Presence::owned);
}

TEST(PairSharing, EvaluatesHalfOfALatticesPairs) {
  // As many particles across the body as need the shortest, the middle and the longest rings.
  for (const auto& [columns, rows] : {std::pair{60, 10}, {40, 20}, {12, 100}}) {
    SCOPED_TRACE(rows);
    const std::vector<Vector> positions = test::lattice(columns, rows, 1.0);
    const Counts counts = expect_that_what_is_asked_for_is_there(positions, all_owned(positions.size()), 2.7);
    EXPECT_GE(counts.answered, counts.asked - 1);  // but what the first block of all has no use for
    EXPECT_GT(counts.asked, 300);
  }
}

TEST(PairSharing, EvaluatesTwiceWhatLiesTooFarBack) {
  const std::vector<Vector> positions = test::lattice(9, 200, 1.0);
  const Counts counts = expect_that_what_is_asked_for_is_there(positions, all_owned(positions.size()), 2.7);
  EXPECT_GT(counts.answered, 0);
  EXPECT_LT(counts.answered, counts.asked);
}

TEST(PairSharing, FindsWhatItAskedForAmongRandomPoints) {
  test::RandomNumbers random(15);
  for (const double width : {10.0, 30.0}) {
    std::vector<Vector> positions;
    for (int k = 0; k < 400; ++k) positions.push_back(random.in_box({0, 0}, {400 / width, width}));
    // Roughly in order, so that offsets differ from block to block but are small; more than there are slots.
    std::sort(positions.begin(), positions.end(), [](const Vector& a, const Vector& b) { return a.x < b.x; });
    expect_that_what_is_asked_for_is_there(positions, all_owned(positions.size()), 2.4);
  }
}

TEST(PairSharing, KeepsSweepsWithAndWithoutGhostsApart) {
  const std::vector<Vector> positions = test::lattice(40, 10, 1.0);
  test::RandomNumbers random(16);
  for (const double share : {0.0, 0.01, 0.2}) {
    std::vector<Presence> rows = all_owned(positions.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (k < 30 || k >= 370 || random.between(0, 1) < share) rows[k] = Presence::ghost;
    const Counts counts = expect_that_what_is_asked_for_is_there(positions, rows, 2.7);
    EXPECT_LT(counts.answered, counts.asked);
  }
}

TEST(PairSharing, IsEmptyWithoutPairs) {
  const Counts counts = expect_that_what_is_asked_for_is_there({{0, 0}, {10, 0}}, all_owned(2), 2.4);
  EXPECT_EQ(counts.evaluated, 0);
}

}  // namespace
}  // namespace sphdrop
