// Rows brought together at one rank, by id or as they arrive, and results brought back to those who sent them.

#include "decomposition/interface_gather.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace sphdrop {
namespace {

// Rank r contributes r + 1 rows of a larger array, not in their order, with ids dealt out over the ranks.
struct Contribution {
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> rows;
  std::vector<double> column;

  explicit Contribution(const Communicator& communicator)
      : column(static_cast<std::size_t>(3 * communicator.size()), -1.0) {
    const int ranks = communicator.size(), rank = communicator.rank();
    for (int k = 0; k <= rank; ++k) {
      ids.push_back(100 - k * ranks - rank);
      rows.push_back(3 * ranks - 1 - 2 * k);
      column[static_cast<std::size_t>(rows.back())] = static_cast<double>(ids.back());
    }
  }
};

void expect_there_and_back(GatheredOrder order) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int ranks = communicator.size(), rank = communicator.rank();
  for (int owner = 0; owner < ranks; ++owner) {
    const Contribution mine(communicator);
    InterfaceGather gather(communicator, mine.ids, mine.rows, owner, 40, order);
    const auto all = static_cast<std::size_t>(rank == owner ? ranks * (ranks + 1) / 2 : 0);
    ASSERT_EQ(gather.ids().size(), all);
    ASSERT_EQ(gather.by_id().size(), all);
    std::vector<std::int64_t> ascending;
    for (const std::int32_t place : gather.by_id()) ascending.push_back(gather.ids()[static_cast<std::size_t>(place)]);
    EXPECT_TRUE(std::is_sorted(ascending.begin(), ascending.end()));
    if (order == GatheredOrder::by_id) {
      EXPECT_TRUE(std::is_sorted(gather.ids().begin(), gather.ids().end()));
    }
    for (std::size_t k = 0; k < all; ++k) EXPECT_EQ(gather.index_of(gather.ids()[k]), static_cast<std::int32_t>(k));
    EXPECT_EQ(gather.index_of(101), -1);

    for (int round = 0; round < 2; ++round) {  // the buffers of the first are used again
      std::vector<double> gathered(all), twice(all), column = mine.column;
      for (double& value : column) value += round;
      gather.start_gather(std::array<const void*, 2>{column.data(), mine.column.data()});
      gather.finish_gather(std::array<void*, 2>{gathered.data(), twice.data()});
      for (std::size_t k = 0; k < all; ++k) {
        EXPECT_EQ(gathered[k], static_cast<double>(gather.ids()[k]) + round);
        EXPECT_EQ(twice[k], static_cast<double>(gather.ids()[k]));
        gathered[k] = 0.5 * gathered[k] + 1.0;
      }
      std::vector<double> returned(mine.rows.size());
      gather.start_scatter(std::array<const void*, 1>{gathered.data()});
      gather.finish_scatter(std::array<void*, 1>{returned.data()});
      for (std::size_t k = 0; k < mine.rows.size(); ++k)
        EXPECT_EQ(returned[k], 0.5 * (static_cast<double>(mine.ids[k]) + round) + 1.0);
    }
  }
}

TEST(InterfaceGather, BringsResultsBackInTheOrderOfTheRowsNamed) {
  expect_there_and_back(GatheredOrder::by_id);
}

TEST(InterfaceGather, DoesSoWithWhatLiesAsItArrives) {
  expect_there_and_back(GatheredOrder::as_arrived);
}

TEST(InterfaceGather, LeavesRowsAsTheyArriveWhereTheyNeedNotBeSorted) {
  const Communicator communicator(MPI_COMM_WORLD);
  const Contribution mine(communicator);
  const int owner = communicator.size() - 1;
  const InterfaceGather gather(communicator, mine.ids, mine.rows, owner, 40, GatheredOrder::as_arrived);
  const std::vector<std::int64_t> expected = communicator.gather(std::span<const std::int64_t>(mine.ids), owner);
  EXPECT_EQ((std::vector<std::int64_t>(gather.ids().begin(), gather.ids().end())), expected);
}

}  // namespace
}  // namespace sphdrop
