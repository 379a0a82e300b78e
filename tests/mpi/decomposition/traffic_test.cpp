// What the communicator says it has exchanged, against what each call is known to move.

#include "decomposition/traffic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "decomposition/exchange_plan.hpp"

namespace sphdrop {
namespace {

std::int64_t as_int(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

TEST(Traffic, OfReductions) {
  const Communicator communicator(MPI_COMM_WORLD);
  communicator.max(1.0);
  communicator.sum(std::int64_t{1});
  std::vector<std::int64_t> sums{1, 2, 3};
  communicator.sum_in_place(sums);
  communicator.barrier();
  PendingMaximum pending(communicator);
  pending.start(std::array{1.0, 2.0});
  pending.finish();
  PendingSum pending_sum(communicator);
  pending_sum.start(std::array<std::int64_t, 1>{4});
  pending_sum.finish();
  EXPECT_EQ(communicator.traffic().of(TrafficKind::reduction), (TrafficCount{3, 8 + 8 + 24}));
  EXPECT_EQ(communicator.traffic().of(TrafficKind::barrier), (TrafficCount{1, 0}));
  EXPECT_EQ(communicator.traffic().of(TrafficKind::pending_reduction), (TrafficCount{2, 16 + 8}));
  EXPECT_EQ(communicator.traffic().collective(), (TrafficCount{6, 40 + 24}));
}

TEST(Traffic, OfGathersAndBroadcasts) {
  const Communicator communicator(MPI_COMM_WORLD);
  const std::int64_t ranks = communicator.size(), rank = communicator.rank();
  const std::vector<double> mine(static_cast<std::size_t>(rank + 1), 0.5);  // 1 + 2 + ... + P items in all
  const std::int64_t items = ranks * (ranks + 1) / 2;
  communicator.all_gather(std::span<const double>(mine));
  EXPECT_EQ(communicator.traffic().of(TrafficKind::gather), (TrafficCount{2, 8 * ranks + 8 * items}));

  const Traffic before = communicator.traffic();
  const int root = communicator.size() - 1;
  communicator.gather(std::span<const double>(mine), root);
  const Traffic gathered = communicator.traffic() - before;
  EXPECT_EQ(gathered.of(TrafficKind::gather), (TrafficCount{2, 8 * ranks + 8 * (rank == root ? items : rank + 1)}));

  std::string text = rank == 0 ? "droplet" : "";
  communicator.broadcast(text, 0);
  EXPECT_EQ(communicator.traffic().of(TrafficKind::broadcast), (TrafficCount{2, 8 + 7}));
}

// Everyone sends k + 1 rows to rank k, itself among them.
TEST(Traffic, OfAPlan) {
  const Communicator communicator(MPI_COMM_WORLD);
  const std::int64_t ranks = communicator.size(), rank = communicator.rank();
  std::vector<RankRows> sends;
  for (int to = 0; to < communicator.size(); ++to) {
    sends.push_back({to, {}});
    for (int k = 0; k <= to; ++k) sends.back().rows.push_back(k);
  }
  ExchangePlan plan = ExchangePlan::from_sends(communicator, std::move(sends), 0, 17);
  EXPECT_EQ(communicator.traffic().of(TrafficKind::all_to_all), (TrafficCount{1, 4 * ranks}));

  const std::vector<double> x(static_cast<std::size_t>(ranks), 1.0), y = x;
  std::vector<double> got_x(plan.received_row_count()), got_y = got_x;
  for (int times = 0; times < 3; ++times) {
    plan.start(std::array<const void*, 2>{x.data(), y.data()});
    plan.finish(std::array<void*, 2>{got_x.data(), got_y.data()});
  }
  const std::int64_t rows_to_others = ranks * (ranks + 1) / 2 - (rank + 1);
  EXPECT_EQ(communicator.traffic().of(TrafficKind::message_sent),
            (TrafficCount{3 * (ranks - 1), 3 * 2 * 8 * rows_to_others}));
  EXPECT_EQ(communicator.traffic().of(TrafficKind::message_received),
            (TrafficCount{3 * (ranks - 1), 3 * 2 * 8 * (ranks - 1) * (rank + 1)}));
  EXPECT_EQ(as_int(plan.message_count()), ranks - 1);

  const Traffic before = communicator.traffic();
  ExchangePlan back = plan.reversed(18);
  EXPECT_EQ(communicator.traffic(), before);
  back.start(std::array<const void*, 1>{got_x.data()});
  std::vector<double> again(x.size());
  back.finish(std::array<void*, 1>{again.data()});
  const Traffic returned = communicator.traffic() - before;
  EXPECT_EQ(returned.of(TrafficKind::message_sent), (TrafficCount{ranks - 1, 8 * (ranks - 1) * (rank + 1)}));
  EXPECT_EQ(returned.of(TrafficKind::message_received), (TrafficCount{ranks - 1, 8 * rows_to_others}));
}

}  // namespace
}  // namespace sphdrop
