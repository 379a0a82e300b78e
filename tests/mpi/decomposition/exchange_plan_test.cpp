#include "decomposition/exchange_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <numeric>
#include <random>

namespace sphdrop {
namespace {

constexpr std::int32_t row_count = 60;

/// Who sends which rows to whom: [from][to], known to all ranks of the test.
using Pattern = std::vector<std::vector<std::vector<std::int32_t>>>;

Pattern random_pattern(std::mt19937& random, int ranks) {
  Pattern pattern(static_cast<std::size_t>(ranks));
  for (auto& from : pattern) {
    from.resize(static_cast<std::size_t>(ranks));
    for (auto& rows : from) {
      if (random() % 3 == 0) continue;
      rows.resize(random() % 25);  // a row may go out several times
      for (std::int32_t& row : rows) row = static_cast<std::int32_t>(random() % row_count);
    }
  }
  return pattern;
}

std::vector<RankRows> sends_of(const Pattern& pattern, int rank) {
  std::vector<RankRows> sends;
  const auto& own = pattern[static_cast<std::size_t>(rank)];
  for (std::size_t to = own.size(); to-- > 0;)  // in any order, empty ones too
    sends.push_back({static_cast<int>(to), own[to]});
  return sends;
}

double real_value(std::size_t rank, std::int32_t row, int column) {
  return 1e4 * static_cast<double>(rank) + row + 0.01 * column;
}
std::int64_t whole_value(std::size_t rank, std::int32_t row) {
  return (std::int64_t{1} << 60) + static_cast<std::int64_t>(rank) * 1000 + row;
}

/// Seven columns of doubles and one of integers.
struct Columns {
  explicit Columns(std::size_t rows) : whole(rows, -1) {
    for (auto& column : real) column.assign(rows, -1.0);
  }
  static Columns filled(std::size_t rank, std::size_t rows) {
    Columns columns(rows);
    for (std::size_t row = 0; row < rows; ++row) {
      const auto r = static_cast<std::int32_t>(row);
      for (int c = 0; c < 7; ++c) columns.real[static_cast<std::size_t>(c)][row] = real_value(rank, r, c);
      columns.whole[row] = whole_value(rank, r);
    }
    return columns;
  }
  std::vector<const void*> sources(std::size_t count) const {
    std::vector<const void*> all{whole.data()};
    for (const auto& column : real) all.push_back(column.data());
    all.resize(count);
    return all;
  }
  std::vector<void*> targets(std::size_t count) {
    std::vector<void*> all{whole.data()};
    for (auto& column : real) all.push_back(column.data());
    all.resize(count);
    return all;
  }
  friend bool operator==(const Columns&, const Columns&) = default;

  std::array<std::vector<double>, 7> real;
  std::vector<std::int64_t> whole;
};

void copy_row(Columns& target, std::size_t to, std::size_t source_rank, std::int32_t from, std::size_t columns) {
  if (columns > 0) target.whole[to] = whole_value(source_rank, from);
  for (std::size_t c = 1; c < columns; ++c)
    target.real[c - 1][to] = real_value(source_rank, from, static_cast<int>(c - 1));
}

class ExchangePlanTest : public testing::Test {
 protected:
  std::size_t rank() const { return static_cast<std::size_t>(communicator.rank()); }
  std::size_t size() const { return static_cast<std::size_t>(communicator.size()); }

  Communicator communicator{MPI_COMM_WORLD};
  std::mt19937 random{7};  // the same numbers on every rank
};

TEST_F(ExchangePlanTest, EqualsABruteForceGather) {
  for (int round = 0; round < 60; ++round) {
    const Pattern pattern = random_pattern(random, communicator.size());
    auto plan = ExchangePlan::from_sends(communicator, sends_of(pattern, communicator.rank()), row_count, 11);
    const Columns original = Columns::filled(rank(), row_count);
    const bool in_place = round % 2 == 0;  // received rows appended to the arrays they come from
    std::size_t arriving = 0;
    for (std::size_t from = 0; from < size(); ++from) arriving += pattern[from][rank()].size();
    ASSERT_EQ(plan.received_row_count(), arriving);

    for (const std::size_t columns : {8U, 8U, 3U, 0U, 5U, 8U}) {  // the same plan again and again
      Columns target = in_place ? Columns::filled(rank(), row_count) : Columns(row_count);
      for (auto& column : target.real) column.resize(row_count + arriving, -1.0);
      target.whole.resize(row_count + arriving, -1);
      Columns expected = target;
      std::size_t to = row_count;
      for (std::size_t from = 0; from < size(); ++from)
        for (const std::int32_t row : pattern[from][rank()]) copy_row(expected, to++, from, row, columns);

      plan.start(in_place ? target.sources(columns) : original.sources(columns));
      plan.finish(target.targets(columns));
      ASSERT_EQ(target, expected) << "round " << round << ", " << columns << " columns";
    }
  }
}

TEST_F(ExchangePlanTest, OwnRowsMayBeSwappedInPlace) {
  // Everyone turns rows 0, 1, 2 of its own and passes row 3 on to the next rank, all within the same array.
  const int next = (communicator.rank() + 1) % communicator.size();
  const int previous = (communicator.rank() + communicator.size() - 1) % communicator.size();
  std::vector<RankRows> sends{{communicator.rank(), {0, 1, 2}}};
  std::vector<RankRows> receives{{communicator.rank(), {1, 2, 0}}};
  if (communicator.size() == 1) {
    sends[0].rows.push_back(3);
    receives[0].rows.push_back(3);
  } else {
    sends.push_back({next, {3}});
    receives.push_back({previous, {3}});
  }
  ExchangePlan plan(communicator, sends, receives, 12);
  std::vector<double> column{0, 1, 2, 10.0 * communicator.rank()};
  plan.start(std::array<const void*, 1>{column.data()});
  plan.finish(std::array<void*, 1>{column.data()});
  EXPECT_EQ(column, (std::vector<double>{2, 0, 1, 10.0 * previous}));
}

TEST_F(ExchangePlanTest, ReversedBringsEverythingBack) {
  for (int round = 0; round < 30; ++round) {
    // Every row goes to exactly one rank, as in a migration or a scatter.
    Pattern pattern(size(), std::vector<std::vector<std::int32_t>>(size()));
    for (auto& from : pattern)
      for (std::int32_t row = 0; row < row_count; ++row) from[random() % size()].push_back(row);
    auto there = ExchangePlan::from_sends(communicator, sends_of(pattern, communicator.rank()), 0, 13);
    auto back = there.reversed(14);
    EXPECT_EQ(back.received_row_count(), static_cast<std::size_t>(row_count));
    EXPECT_EQ(back.reversed(13).message_count(), there.message_count());

    const Columns original = Columns::filled(rank(), row_count);
    Columns visited(there.received_row_count());
    there.start(original.sources(8));
    there.finish(visited.targets(8));
    for (double& value : visited.real[2]) value *= 2;  // work done abroad
    Columns returned(row_count);
    back.start(visited.sources(8));
    back.finish(returned.targets(8));
    Columns expected = original;
    for (double& value : expected.real[2]) value *= 2;
    ASSERT_EQ(returned, expected);
  }
}

TEST_F(ExchangePlanTest, FollowsArraysThatAreReordered) {
  for (int round = 0; round < 30; ++round) {
    const Pattern pattern = random_pattern(random, communicator.size());
    std::vector<std::int32_t> new_row(row_count);
    std::iota(new_row.begin(), new_row.end(), 0);
    std::shuffle(new_row.begin(), new_row.end(), random);
    auto plan = ExchangePlan::from_sends(communicator, sends_of(pattern, communicator.rank()), 0, 15);
    const Columns original = Columns::filled(rank(), row_count);
    Columns plain(plan.received_row_count());
    plan.start(original.sources(8));
    plan.finish(plain.targets(8));

    Columns reordered(row_count);
    for (std::size_t row = 0; row < row_count; ++row) {
      const auto to = static_cast<std::size_t>(new_row[row]);
      for (std::size_t c = 0; c < 7; ++c) reordered.real[c][to] = original.real[c][row];
      reordered.whole[to] = original.whole[row];
    }
    std::vector<std::int32_t> new_place(plan.received_row_count());
    std::iota(new_place.begin(), new_place.end(), 0);
    std::reverse(new_place.begin(), new_place.end());
    plan.renumber_sent_rows(new_row);
    plan.renumber_received_rows(new_place);
    Columns mirrored(plan.received_row_count());
    plan.start(reordered.sources(8));
    plan.finish(mirrored.targets(8));
    for (auto& column : mirrored.real) std::reverse(column.begin(), column.end());
    std::reverse(mirrored.whole.begin(), mirrored.whole.end());
    ASSERT_EQ(mirrored, plain);
  }
}

TEST_F(ExchangePlanTest, WithoutRowsDoesNothing) {
  std::vector<double> column(3, 5.0);
  const auto exchange = [&](ExchangePlan& plan) {
    plan.start(std::array<const void*, 1>{column.data()});
    plan.finish(std::array<void*, 1>{column.data()});
    EXPECT_EQ(column, std::vector<double>(3, 5.0));
    EXPECT_EQ(plan.received_row_count() + plan.message_count() + plan.sent_row_count(), 0U);
    EXPECT_TRUE(plan.sends().empty() && plan.receives().empty());
  };
  ExchangePlan none;
  exchange(none);
  ExchangePlan reversed = none.reversed(1);
  exchange(reversed);
  auto agreed = ExchangePlan::from_sends(communicator, {}, 0, 16);
  exchange(agreed);
  auto empty_lists = ExchangePlan::from_sends(communicator, {{0, {}}, {communicator.size() - 1, {}}}, 0, 16);
  if (communicator.size() > 1) exchange(empty_lists);
}

TEST_F(ExchangePlanTest, CountsWhatLeavesTheRank) {
  std::vector<RankRows> sends;
  for (int to = communicator.size() - 1; to >= 0; --to) sends.push_back({to, {0, 1, 2}});
  const auto plan = ExchangePlan::from_sends(communicator, sends, 5, 17);
  EXPECT_EQ(plan.received_row_count(), 3 * size());
  EXPECT_EQ(plan.message_count(), size() - 1);
  EXPECT_EQ(plan.sent_row_count(), 3 * (size() - 1));
  ASSERT_EQ(plan.receives().size(), size());
  for (int from = 0; from < communicator.size(); ++from) {
    const RankRows& received = plan.receives()[static_cast<std::size_t>(from)];
    EXPECT_EQ(received.rank, from);
    EXPECT_EQ(received.rows, (std::vector<std::int32_t>{5 + 3 * from, 6 + 3 * from, 7 + 3 * from}));
    EXPECT_EQ(plan.sends()[static_cast<std::size_t>(from)].rank, from);
  }
}

TEST_F(ExchangePlanTest, CopiesAndMovesWork) {
  const int next = (communicator.rank() + 1) % communicator.size();
  const double from_previous = (communicator.rank() + communicator.size() - 1) % communicator.size();
  const std::vector<double> source(1, communicator.rank());
  std::vector<double> target(1);
  const auto start = [&](ExchangePlan& plan) { plan.start(std::array<const void*, 1>{source.data()}); };
  const auto finish = [&](ExchangePlan& plan) {
    target[0] = -1;
    plan.finish(std::array<void*, 1>{target.data()});
    EXPECT_EQ(target[0], from_previous);
  };
  ExchangePlan plan;
  plan = ExchangePlan::from_sends(communicator, {{next, {0}}}, 0, 18);
  start(plan);
  finish(plan);
  ExchangePlan copy = plan;
  start(copy);
  start(plan);  // each has its own buffers; messages of one tag arrive in the order in which they were sent
  finish(copy);
  finish(plan);
  start(plan);
  ExchangePlan moved = std::move(plan);  // also with messages under way
  finish(moved);
  start(moved);
  copy = std::move(moved);
  finish(copy);
  copy = copy.reversed(19).reversed(20);
  start(copy);
  finish(copy);
}

TEST_F(ExchangePlanTest, MayBeForgottenWhileUnderWay) {
  const int next = (communicator.rank() + 1) % communicator.size();
  const std::vector<double> source(20000, 1.0);  // beyond what is sent without waiting for the receiver
  std::vector<std::int32_t> rows(source.size());
  std::iota(rows.begin(), rows.end(), 0);
  {
    auto plan = ExchangePlan::from_sends(communicator, {{next, rows}}, 0, 21);
    plan.start(std::array<const void*, 1>{source.data()});
    auto replaced = ExchangePlan::from_sends(communicator, {{next, rows}}, 0, 23);
    replaced.start(std::array<const void*, 1>{source.data()});
    replaced = ExchangePlan();
  }
  auto plan = ExchangePlan::from_sends(communicator, {{next, rows}}, 0, 22);
  std::vector<double> target(source.size(), 0.0);
  plan.start(std::array<const void*, 1>{source.data()});
  plan.finish(std::array<void*, 1>{target.data()});
  EXPECT_EQ(target, source);
}

TEST_F(ExchangePlanTest, SeveralPlansMayBeUnderWay) {
  std::vector<ExchangePlan> plans;
  std::vector<Pattern> patterns;
  for (int k = 0; k < 4; ++k) {
    patterns.push_back(random_pattern(random, communicator.size()));
    plans.push_back(ExchangePlan::from_sends(communicator, sends_of(patterns.back(), communicator.rank()), 0, 30 + k));
  }
  const Columns original = Columns::filled(rank(), row_count);
  // Ranks start and finish them in different orders: only the tags tell the messages apart.
  std::vector<std::size_t> order{0, 1, 2, 3};
  std::rotate(order.begin(), order.begin() + communicator.rank() % 4, order.end());
  for (const std::size_t k : order) plans[k].start(original.sources(8));
  for (std::size_t k = 4; k-- > 0;) {
    Columns target(plans[k].received_row_count());
    Columns expected = target;
    plans[k].finish(target.targets(8));
    std::size_t to = 0;
    for (std::size_t from = 0; from < size(); ++from)
      for (const std::int32_t row : patterns[k][from][rank()]) copy_row(expected, to++, from, row, 8);
    EXPECT_EQ(target, expected);
  }
}

}  // namespace
}  // namespace sphdrop
