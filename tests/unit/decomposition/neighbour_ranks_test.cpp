#include "decomposition/neighbour_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace sphdrop {
namespace {

constexpr int own_rank = 1;

/// A blob of cells whose owners form patches, with holes and a few far islands.
CellOwners patchwork(std::mt19937& random, int ranks) {
  CellOwners table;
  const auto add = [&table](Cell cell, int owner) {
    if (table.index.find(cell) != CellIndex::absent) return;
    table.index.insert(cell);
    table.owners.push_back(owner);
  };
  for (std::int32_t column = -12; column < 12; ++column)
    for (std::int32_t row = -6; row < 6; ++row)
      if (random() % 8 != 0)
        add({column, row}, static_cast<int>(static_cast<unsigned>(column + 12) / 4 + random() % 9 / 8) % ranks);
  for (int k = 0; k < 5; ++k)
    add({40 + static_cast<std::int32_t>(random() % 9), -20}, static_cast<int>(random() % static_cast<unsigned>(ranks)));
  return table;
}

std::vector<int> brute_force(const CellOwners& table, double u, double v, double reach) {
  std::set<int> ranks;
  for (std::size_t k = 0; k < table.index.size(); ++k) {
    const Cell cell = table.index.cells()[k];
    const double du = u - std::clamp(u, double{1} * cell.column, cell.column + 1.0);
    const double dv = v - std::clamp(v, double{1} * cell.row, cell.row + 1.0);
    if (table.owners[k] != own_rank && std::hypot(du, dv) <= reach) ranks.insert(table.owners[k]);
  }
  return {ranks.begin(), ranks.end()};
}

TEST(NeighbourRanks, EqualBruteForceForAnyReachInAnyOrder) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-14, 50), v(-22, 8), near_u(-13, 13), near_v(-7, 7);
  const double reaches[] = {0, 0.1, 0.5, 0.99, 1.3, 2.5, 4, 11.7, 60, 1e6, std::numeric_limits<double>::infinity()};
  std::size_t found = 0;
  for (int round = 0; round < 4; ++round) {
    const int ranks = 2 + round;
    NeighbourRanks neighbour_ranks(own_rank);
    for (int table_version = 0; table_version < 2; ++table_version) {
      const CellOwners table = patchwork(random, ranks);
      neighbour_ranks.forget();
      for (int k = 0; k < 2000; ++k) {
        // Mostly one reach for a while, as in use; sometimes a new one each time.
        const double reach = reaches[(k < 1500 ? static_cast<unsigned>(k) / 125 : random()) % std::size(reaches)];
        const bool near = random() % 4 != 0;
        const double pu = near ? near_u(random) : u(random);
        const double pv = near ? near_v(random) : v(random);
        std::vector<int> answer{99};
        neighbour_ranks.append(table, pu, pv, reach, answer);
        ASSERT_EQ(answer.front(), 99) << "what was in the list must stay";
        answer.erase(answer.begin());
        ASSERT_EQ(answer, brute_force(table, pu, pv, reach)) << pu << " " << pv << " " << reach;
        found += answer.size();
      }
    }
  }
  EXPECT_GT(found, 3000U);
}

TEST(NeighbourRanks, TouchingCountsAsWithinReach) {
  CellOwners table;
  table.index.insert({0, 0});
  table.index.insert({2, 0});
  table.index.insert({-1, 1});
  table.owners = {own_rank, 0, 2};
  NeighbourRanks neighbour_ranks(own_rank);
  std::vector<int> ranks;
  neighbour_ranks.append(table, 0.25, 0.5, 1.75, ranks);
  EXPECT_EQ(ranks, (std::vector<int>{0, 2}));
  ranks.clear();
  neighbour_ranks.append(table, 0.25, 0.5, 1.75 - 1e-9, ranks);
  EXPECT_EQ(ranks, (std::vector<int>{2}));
  ranks.clear();
  neighbour_ranks.append(table, 0.25, 0.5, 0.5, ranks);
  EXPECT_TRUE(ranks.empty());
}

}  // namespace
}  // namespace sphdrop
