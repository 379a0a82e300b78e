// Rows brought together at one rank, and results brought back to those who sent them.

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

TEST(InterfaceGather, BringsResultsBackInTheOrderOfTheRowsNamed) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int ranks = communicator.size(), rank = communicator.rank();
  for (int owner = 0; owner < ranks; ++owner) {
    const Contribution mine(communicator);
    InterfaceGather gather(communicator, mine.ids, mine.rows, owner, 40);
    const auto all = static_cast<std::size_t>(rank == owner ? ranks * (ranks + 1) / 2 : 0);
    ASSERT_EQ(gather.ids().size(), all);
    EXPECT_TRUE(std::is_sorted(gather.ids().begin(), gather.ids().end()));

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

// What the owner works out for all may be wanted by several.
TEST(InterfaceGather, BringsResultsToAllWhoNameAnId) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int rank = communicator.rank(), owner = communicator.size() - 1;
  const std::vector<std::int64_t> ids{7, 100 + rank, 3};
  const std::vector<std::int32_t> rows{0, 1, 2};
  InterfaceGather gather(communicator, ids, rows, owner, 40);
  std::vector<double> results;
  for (const std::int64_t id : gather.ids()) results.push_back(0.5 * static_cast<double>(id));
  ASSERT_EQ(results.size(), static_cast<std::size_t>(rank == owner ? 3 * communicator.size() : 0));
  std::vector<double> returned(3);
  gather.start_scatter(std::array<const void*, 1>{results.data()});
  gather.finish_scatter(std::array<void*, 1>{returned.data()});
  EXPECT_EQ(returned, (std::vector<double>{3.5, 50.0 + 0.5 * rank, 1.5}));
}

}  // namespace
}  // namespace sphdrop
