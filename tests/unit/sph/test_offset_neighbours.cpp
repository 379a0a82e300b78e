#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "particles/pack.hpp"
#include "particles/solid_particles.hpp"
#include "sph/offset_neighbours.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

using test::Presence;

/// Rows with ascending ids that have gaps.
void place(SolidParticles& solid, const std::vector<Vector>& positions, const std::vector<Presence>& rows) {
  solid.resize(positions.size());
  for (std::size_t row = 0; row < positions.size(); ++row) {
    solid.id[row] = static_cast<std::int64_t>(row * row + 3);
    solid.position.set(row, positions[row]);
  }
  test::set_ranges(solid, rows);
}

void expect_equal_to_brute_force(const SolidParticles& solid, const std::vector<Presence>& rows, double reach) {
  const OffsetNeighbours list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, reach);
  std::size_t next_block = 0;
  std::int32_t next_offset = 0;
  std::int64_t pairs = 0;
  for (std::size_t first = 0; first < solid.size(); first += block_size) {
    std::set<std::int32_t> expected;
    bool any_owned = false, needs_ghosts = false;
    for (std::size_t i = first; i < std::min(first + block_size, solid.size()); ++i) {
      if (rows[i] != Presence::owned) continue;
      any_owned = true;
      for (std::size_t j = 0; j < solid.size(); ++j) {
        if (j == i || squared_length(solid.position.at(j) - solid.position.at(i)) >= reach * reach) continue;
        ++pairs;
        expected.insert(static_cast<std::int32_t>(j) - static_cast<std::int32_t>(i));
        needs_ghosts = needs_ghosts || rows[j] == Presence::ghost;
      }
    }
    if (!any_owned) continue;
    ASSERT_LT(next_block, list.blocks.size());
    const OffsetNeighbours::Block& block = list.blocks[next_block++];
    EXPECT_EQ(block.first_row, static_cast<std::int32_t>(first));
    EXPECT_EQ(block.needs_ghosts, needs_ghosts) << "block at row " << first;
    ASSERT_EQ(block.first_offset, next_offset);
    ASSERT_EQ(block.offsets, static_cast<std::int32_t>(expected.size()));
    const auto begin = list.offsets.begin() + block.first_offset;
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), begin)) << "block at row " << first;  // ascending
    next_offset += block.offsets;
    // All a sweep loads must lie in the columns or their padding.
    if (block.offsets > 0) {
      EXPECT_GE(block.first_row + *begin, -static_cast<std::int32_t>(column_padding));
      EXPECT_LE(block.first_row + block_size + *(begin + block.offsets - 1),
                static_cast<std::int32_t>(solid.size() + column_padding));
    }
  }
  EXPECT_EQ(next_block, list.blocks.size());
  EXPECT_EQ(static_cast<std::size_t>(next_offset), list.offsets.size());
  EXPECT_EQ(list.pairs, pairs);
}

std::vector<Presence> all_owned(std::size_t rows) {
  return std::vector<Presence>(rows, Presence::owned);
}

TEST(OffsetNeighbours, EqualBruteForceOnALattice) {
  SolidParticles solid;
  const std::vector<Vector> positions = test::lattice(21, 10, 1.0);
  const std::vector<Presence> rows = all_owned(positions.size());
  place(solid, positions, rows);
  // sqrt(5) is a distance of the lattice: a point at exactly the reach is not listed.
  for (const double reach : {1.0, std::sqrt(5.0), 2.4, 2.75, 3.6}) expect_equal_to_brute_force(solid, rows, reach);
}

TEST(OffsetNeighbours, AreTwentyOffsetsInTheBulkOfALattice) {
  SolidParticles solid;
  const std::vector<Vector> positions = test::lattice(40, 10, 1.0);
  place(solid, positions, all_owned(positions.size()));
  const OffsetNeighbours list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, 2.4);
  EXPECT_EQ(list.blocks.size(), 50u);
  EXPECT_EQ(list.blocks[20].offsets, 20);  // those of the disc of radius 2.4 d
}

TEST(OffsetNeighbours, EqualBruteForceOnRandomPointsInAnyOrder) {
  test::RandomNumbers random(13);
  std::vector<Vector> positions;
  positions.reserve(203);
  for (int k = 0; k < 203; ++k) positions.push_back(random.in_box({0, 0}, {14, 14}));
  const std::vector<Presence> rows = all_owned(positions.size());
  SolidParticles solid;
  place(solid, positions, rows);
  for (const double reach : {0.3, 2.4, 3.6}) expect_equal_to_brute_force(solid, rows, reach);
}

TEST(OffsetNeighbours, KnowWhichBlocksNeedGhosts) {
  SolidParticles solid;
  const std::vector<Vector> positions = test::lattice(30, 7, 1.0);
  test::RandomNumbers random(14);
  // Ghost columns at both ends and single ghost rows in between.
  std::vector<Presence> rows = all_owned(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (k < 21 || k >= 170 || random.between(0, 1) < 0.02) rows[k] = Presence::ghost;
  place(solid, positions, rows);
  for (const double reach : {1.1, 2.4, 3.0}) expect_equal_to_brute_force(solid, rows, reach);
}

TEST(OffsetNeighbours, BlocksOfGhostsAloneAreLeftOut) {
  SolidParticles solid;
  const std::vector<Vector> positions = test::lattice(8, 8, 1.0);
  std::vector<Presence> rows(positions.size(), Presence::ghost);
  rows[27] = Presence::owned;
  place(solid, positions, rows);
  expect_equal_to_brute_force(solid, rows, 2.4);
  const OffsetNeighbours list = OffsetNeighbours::build(solid, solid.position.x, solid.position.y, 2.4);
  ASSERT_EQ(list.blocks.size(), 1u);
  EXPECT_EQ(list.blocks[0].first_row, 24);
  EXPECT_TRUE(list.blocks[0].needs_ghosts);
}

TEST(OffsetNeighbours, AnEmptySetHasNoBlocks) {
  SolidParticles solid;
  EXPECT_TRUE(OffsetNeighbours::build(solid, solid.position.x, solid.position.y, 2.4).blocks.empty());
}

TEST(OffsetNeighbours, ALoneParticleHasABlockWithoutOffsets) {
  SolidParticles solid;
  const std::vector<Presence> rows = all_owned(1);
  place(solid, {{3, 4}}, rows);
  expect_equal_to_brute_force(solid, rows, 2.4);
}

}  // namespace
}  // namespace sphdrop
