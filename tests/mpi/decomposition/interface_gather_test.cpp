// Rows brought together at one rank in ascending id, and results brought back to those who sent them.

#include "decomposition/interface_gather.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace sphdrop {
namespace {

TEST(InterfaceGather, BringsResultsBackInTheOrderOfTheRowsNamed) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int ranks = communicator.size(), rank = communicator.rank();
  for (int owner = 0; owner < ranks; ++owner) {
    // Rank r contributes r rows of a larger array, not in their order, with ids dealt out over the ranks.
    std::vector<std::int64_t> ids;
    std::vector<std::int32_t> rows;
    std::vector<double> column(static_cast<std::size_t>(3 * ranks), -1.0);
    for (int k = 0; k < rank; ++k) {
      ids.push_back(100 - k * ranks - rank);
      rows.push_back(3 * ranks - 1 - 2 * k);
      column[static_cast<std::size_t>(rows.back())] = static_cast<double>(ids.back());
    }
    InterfaceGather gather(communicator, ids, rows, owner, 40);
    const std::size_t all = static_cast<std::size_t>(rank == owner ? ranks * (ranks - 1) / 2 : 0);
    ASSERT_EQ(gather.ids().size(), all);
    EXPECT_TRUE(std::is_sorted(gather.ids().begin(), gather.ids().end()));
    std::vector<double> gathered(all);
    gather.start_gather(std::array<const void*, 1>{column.data()});
    gather.finish_gather(std::array<void*, 1>{gathered.data()});
    for (std::size_t k = 0; k < all; ++k) {
      EXPECT_EQ(gathered[k], static_cast<double>(gather.ids()[k]));
      gathered[k] = 0.5 * gathered[k] + 1.0;
    }
    std::vector<double> returned(rows.size());
    gather.start_scatter(std::array<const void*, 1>{gathered.data()});
    gather.finish_scatter(std::array<void*, 1>{returned.data()});
    for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(returned[k], 0.5 * static_cast<double>(ids[k]) + 1.0);
  }
}

}  // namespace
}  // namespace sphdrop
