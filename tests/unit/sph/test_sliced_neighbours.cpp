#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "particles/fluid_particles.hpp"
#include "particles/pack.hpp"
#include "sph/sliced_neighbours.hpp"
#include "tests/support/particle_samples.hpp"

namespace sphdrop {
namespace {

/// Rows with scattered, unordered ids.
void place(FluidParticles& fluid, const std::vector<Vector>& positions, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  fluid.resize(positions.size());
  std::vector<std::int32_t> ids = test::first_ids(positions.size());
  random.shuffle(ids);
  for (std::size_t row = 0; row < positions.size(); ++row) {
    fluid.id[row] = 3 * ids[row] + 5;
    fluid.position.set(row, positions[row]);
  }
}

std::vector<std::int32_t> brute_force(const FluidParticles& fluid, std::size_t row, double reach) {
  std::vector<std::pair<std::int64_t, std::int32_t>> found;
  for (std::size_t j = 0; j < fluid.size(); ++j)
    if (j != row && squared_length(fluid.position.at(j) - fluid.position.at(row)) < reach * reach)
      found.emplace_back(fluid.id[j], static_cast<std::int32_t>(j));
  std::sort(found.begin(), found.end());
  std::vector<std::int32_t> rows;
  rows.reserve(found.size());
  for (const auto& [id, j] : found) rows.push_back(j);
  return rows;
}

void expect_equal_to_brute_force(const FluidParticles& fluid, RowRange range, double reach) {
  const SlicedNeighbours list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, range, reach);
  std::int32_t next_row = range.begin, next_entry = 0;
  std::int64_t pairs = 0;
  const auto padding = static_cast<std::int32_t>(fluid.size());
  for (const SlicedNeighbours::Slice& slice : list.slices) {
    ASSERT_EQ(slice.first_row, next_row);
    ASSERT_EQ(slice.rows, std::min<std::int32_t>(block_size, range.end - next_row));
    ASSERT_EQ(slice.first_entry, next_entry);
    std::int32_t longest = 0;
    for (std::int32_t lane = 0; lane < block_size; ++lane) {
      std::vector<std::int32_t> expected;
      if (lane < slice.rows)
        expected =
            brute_force(fluid, static_cast<std::size_t>(slice.first_row) + static_cast<std::size_t>(lane), reach);
      pairs += static_cast<std::int64_t>(expected.size());
      longest = std::max(longest, static_cast<std::int32_t>(expected.size()));
      ASSERT_LE(expected.size(), static_cast<std::size_t>(slice.entries));
      expected.resize(static_cast<std::size_t>(slice.entries), padding);
      for (std::int32_t entry = 0; entry < slice.entries; ++entry)
        EXPECT_EQ(list.neighbours[(static_cast<std::size_t>(slice.first_entry) + static_cast<std::size_t>(entry)) *
                                      block_size +
                                  static_cast<std::size_t>(lane)],
                  expected[static_cast<std::size_t>(entry)])
            << "row " << slice.first_row + lane << ", entry " << entry;
    }
    EXPECT_EQ(slice.entries, longest);
    next_row += slice.rows;
    next_entry += slice.entries;
  }
  EXPECT_EQ(next_row, range.end);
  EXPECT_EQ(list.neighbours.size(), static_cast<std::size_t>(next_entry) * block_size);
  EXPECT_EQ(list.pairs, pairs);
}

TEST(SlicedNeighbours, EqualBruteForceOnRandomPoints) {
  test::RandomNumbers random(7);
  std::vector<Vector> positions;
  positions.reserve(300);
  for (int k = 0; k < 300; ++k) positions.push_back(random.in_box({0, 0}, {16, 19}));
  FluidParticles fluid;
  place(fluid, positions, 8);
  for (const double reach : {0.3, 2.4, 3.6}) expect_equal_to_brute_force(fluid, {0, 300}, reach);
}

TEST(SlicedNeighbours, EqualBruteForceOnALattice) {
  FluidParticles fluid;
  place(fluid, test::lattice(13, 11, 1.0), 9);
  // 2 and sqrt(8) are distances of the lattice: a point at exactly the reach is not listed.
  for (const double reach : {2.0, 2.4, std::sqrt(8.0), 2.9}) expect_equal_to_brute_force(fluid, {0, 143}, reach);
}

TEST(SlicedNeighbours, ListsTheRowsAskedForAndNamesGhostsAmongTheirNeighbours) {
  FluidParticles fluid;
  place(fluid, test::lattice(13, 11, 1.0), 10);
  for (const RowRange range : {RowRange{0, 1}, RowRange{3, 20}, RowRange{40, 48}, RowRange{100, 143}})
    expect_equal_to_brute_force(fluid, range, 2.4);
}

TEST(SlicedNeighbours, NoRowsMakeNoSlices) {
  FluidParticles fluid;
  place(fluid, test::lattice(3, 3, 1.0), 11);
  const auto none = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, {4, 4}, 2.4);
  EXPECT_TRUE(none.slices.empty());
  EXPECT_EQ(none.pairs, 0);
  FluidParticles empty;
  EXPECT_TRUE(SlicedNeighbours::build(empty, empty.position.x, empty.position.y, {0, 0}, 2.4).slices.empty());
}

TEST(SlicedNeighbours, ALoneParticleHasASliceWithoutEntries) {
  FluidParticles fluid;
  place(fluid, {{1, 1}}, 12);
  const auto list = SlicedNeighbours::build(fluid, fluid.position.x, fluid.position.y, {0, 1}, 2.4);
  ASSERT_EQ(list.slices.size(), 1u);
  EXPECT_EQ(list.slices[0].rows, 1);
  EXPECT_EQ(list.slices[0].entries, 0);
}

}  // namespace
}  // namespace sphdrop
