#include "decomposition/communicator.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>

namespace sphdrop {
namespace {

struct Item {
  std::int32_t rank;
  std::int16_t number;
  double value;
};

TEST(Communicator, Reduces) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int rank = communicator.rank();
  const int size = communicator.size();
  EXPECT_EQ(communicator.max(1.5 * rank), 1.5 * (size - 1));
  EXPECT_EQ(communicator.min(-1.5 * rank), -1.5 * (size - 1));
  EXPECT_EQ(communicator.max(std::int64_t{1} << 40 | rank), std::int64_t{1} << 40 | (size - 1));
  EXPECT_EQ(communicator.min(std::int64_t{rank + 3}), 3);
  EXPECT_EQ(communicator.sum(std::int64_t{rank - 1}), size * (size - 1) / 2 - size);
  EXPECT_EQ(communicator.sum(std::numeric_limits<std::uint64_t>::max()),
            std::uint64_t{0} - static_cast<std::uint64_t>(size));
  std::vector<double> maxima{1.0 * rank, -1.0 * rank};
  communicator.max_in_place(maxima);
  EXPECT_EQ(maxima, (std::vector<double>{1.0 * (size - 1), 0}));
  std::vector<std::int64_t> sums{1, rank};
  communicator.sum_in_place(sums);
  EXPECT_EQ(sums, (std::vector<std::int64_t>{size, size * (size - 1) / 2}));
}

TEST(Communicator, GathersUnevenShares) {
  const Communicator communicator(MPI_COMM_WORLD);
  // Rank 0 and every third rank have nothing.
  const auto share = [](int rank) {
    std::vector<Item> items;
    for (int k = 0; k < rank % 3 * 2; ++k) items.push_back({rank, static_cast<std::int16_t>(k), 0.5 * rank + k});
    return items;
  };
  const std::vector<Item> mine = share(communicator.rank());
  std::vector<Item> expected;
  for (int rank = 0; rank < communicator.size(); ++rank)
    for (const Item& item : share(rank)) expected.push_back(item);
  const auto check = [&](const std::vector<Item>& all) {
    ASSERT_EQ(all.size(), expected.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(all[k].rank, expected[k].rank);
      EXPECT_EQ(all[k].number, expected[k].number);
      EXPECT_EQ(all[k].value, expected[k].value);
    }
  };
  check(communicator.all_gather<Item>(mine));
  for (int root = 0; root < communicator.size(); ++root) {
    const auto gathered = communicator.gather<Item>(mine, root);
    if (communicator.rank() == root)
      check(gathered);
    else
      EXPECT_TRUE(gathered.empty());
  }
  EXPECT_TRUE(communicator.all_gather<double>({}).empty());
}

TEST(Communicator, Broadcasts) {
  const Communicator communicator(MPI_COMM_WORLD);
  for (int root = 0; root < communicator.size(); ++root) {
    const bool is_root = communicator.rank() == root;
    std::vector<double> items = is_root ? std::vector<double>{1.5, -2.0, 3.25} : std::vector<double>(7, 9.0);
    communicator.broadcast(items, root);
    EXPECT_EQ(items, (std::vector<double>{1.5, -2.0, 3.25}));
    std::string text = is_root ? "rank " + std::to_string(root) : "what was here before, and longer";
    communicator.broadcast(text, root);
    EXPECT_EQ(text, "rank " + std::to_string(root));
    if (is_root) text.clear();
    communicator.broadcast(text, root);
    EXPECT_EQ(text, "");
  }
}

TEST(PendingMaximum, IsTheMaximumTimeAfterTime) {
  const Communicator communicator(MPI_COMM_WORLD);
  PendingMaximum pending(communicator);
  const double rank = communicator.rank();
  const double last = communicator.size() - 1;
  for (int step = 0; step < 50; ++step) {
    std::vector<double> values{rank + step, -rank, 7.0};
    if (step % 10 == 9) values.push_back(step * rank);
    const std::size_t count = values.size();
    pending.start(values);
    values.assign(values.size(), 1e9);  // the caller's array is free again
    const auto maxima = pending.finish();
    ASSERT_EQ(maxima.size(), count);
    EXPECT_EQ(maxima[0], last + step);
    EXPECT_EQ(maxima[1], 0);
    EXPECT_EQ(maxima[2], 7);
    if (count > 3) {
      EXPECT_EQ(maxima[3], step * last);
    }
  }
}

// What was left under way would crash MPI_Finalize at the end of this program.
TEST(PendingMaximum, EndsWhenAllRanksLeaveByAnError) {
  for (int repetition = 0; repetition < 20; ++repetition) {
    try {
      const Communicator communicator(MPI_COMM_WORLD);
      PendingMaximum pending(communicator);
      pending.start(std::vector<double>{1.0});
      throw std::runtime_error("of all ranks");
    } catch (const std::runtime_error&) {
    }
  }
}

TEST(PendingMaximum, MayBeForgottenWhileUnderWay) {
  const Communicator communicator(MPI_COMM_WORLD);
  {
    PendingMaximum pending(communicator);
    pending.start(std::vector<double>{1.0});
  }
  EXPECT_EQ(communicator.sum(std::int64_t{1}), communicator.size());
}

TEST(PendingSum, IsTheSumTimeAfterTime) {
  const Communicator communicator(MPI_COMM_WORLD);
  PendingSum pending(communicator);
  const std::int64_t rank = communicator.rank(), size = communicator.size();
  EXPECT_FALSE(pending.is_under_way());
  for (std::int64_t step = 0; step < 50; ++step) {
    std::vector<std::int64_t> values{rank + step, -(std::int64_t{1} << 52) - rank};
    pending.start(values);
    values.assign(values.size(), 12345);  // the caller's array is free again
    EXPECT_TRUE(pending.is_under_way());
    EXPECT_EQ(communicator.sum(std::int64_t{1}), size);  // another collective in between does no harm
    const auto sums = pending.finish();
    ASSERT_EQ(sums.size(), 2u);
    EXPECT_EQ(sums[0], size * (size - 1) / 2 + size * step);
    EXPECT_EQ(sums[1], -size * (std::int64_t{1} << 52) - size * (size - 1) / 2);
    EXPECT_FALSE(pending.is_under_way());
  }
}

TEST(PendingSum, MayBeForgottenWhileUnderWay) {
  const Communicator communicator(MPI_COMM_WORLD);
  {
    PendingSum pending(communicator);
    pending.start(std::vector<std::int64_t>{1});
  }
  EXPECT_EQ(communicator.sum(std::int64_t{1}), communicator.size());
}

}  // namespace
}  // namespace sphdrop
