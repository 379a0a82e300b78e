// Own rows with copies of others' behind them.

#include "decomposition/collected_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sphdrop {
namespace {

// Rank r has the ids r, r + P, r + 2P, ... in falling order, and shows its rows 1 and 3 to the next rank, 3 to the one
// after that.
struct Rows {
  std::vector<std::int64_t> ids;
  std::vector<RankRows> sends;

  explicit Rows(const Communicator& communicator) {
    const int ranks = communicator.size(), rank = communicator.rank();
    for (int k = 5; k >= 0; --k) ids.push_back(rank + std::int64_t{k} * ranks);
    std::vector<std::vector<std::int32_t>> to(static_cast<std::size_t>(ranks));
    if (ranks > 1) to[static_cast<std::size_t>((rank + 1) % ranks)] = {1, 3};
    if (ranks > 2) to[static_cast<std::size_t>((rank + 2) % ranks)] = {3};
    for (int other = 0; other < ranks; ++other)
      if (auto& rows = to[static_cast<std::size_t>(other)]; !rows.empty()) sends.push_back({other, rows});
  }
};

TEST(CollectedRows, AreTheOwnOnesAndWhatOthersSend) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int ranks = communicator.size(), rank = communicator.rank();
  const Rows mine(communicator);
  const std::vector<std::int32_t> own{0, 1, 4};
  CollectedRows rows(communicator, mine.ids, own, mine.sends, 60);
  std::vector<std::int64_t> expected;
  const auto add = [&](int of, int row) { expected.push_back(of + std::int64_t{5 - row} * ranks); };
  for (const std::int32_t row : own) add(rank, row);
  for (int other = 0; other < ranks; ++other) {  // they come in the order of their ranks
    const int behind = (rank - other + ranks) % ranks;
    if (ranks > 1 && behind == 1) add(other, 1), add(other, 3);
    if (ranks > 2 && behind == 2) add(other, 3);
  }
  ASSERT_EQ((std::vector<std::int64_t>(rows.order().ids().begin(), rows.order().ids().end())), expected);
  ASSERT_EQ(rows.size(), expected.size());
  EXPECT_EQ((std::vector<std::int32_t>(rows.own_rows().begin(), rows.own_rows().end())), own);

  for (double factor : {1.0, 3.0}) {
    std::vector<double> column, other_column, collected(rows.size()), others(rows.size());
    for (const std::int64_t id : mine.ids) {
      column.push_back(factor * static_cast<double>(id));
      other_column.push_back(-column.back());
    }
    rows.start(std::array<const void*, 2>{column.data(), other_column.data()});
    rows.finish(std::array<void*, 2>{collected.data(), others.data()});
    for (std::size_t k = 0; k < rows.size(); ++k) {
      EXPECT_EQ(collected[k], factor * static_cast<double>(expected[k]));
      EXPECT_EQ(others[k], -collected[k]);
    }
    std::vector<double> pairs(2 * rows.size());
    rows.start(std::array<const void*, 2>{column.data(), other_column.data()});
    rows.finish_pairs(pairs.data());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      EXPECT_EQ(pairs[2 * k], collected[k]);
      EXPECT_EQ(pairs[2 * k + 1], others[k]);
    }
  }
}

TEST(CollectedRows, MayBeNone) {
  const Communicator communicator(MPI_COMM_WORLD);
  CollectedRows rows(communicator, {}, {}, {}, 60);
  EXPECT_EQ(rows.size(), 0U);
  EXPECT_EQ(rows.order().place_of(0), -1);
}

}  // namespace
}  // namespace sphdrop
