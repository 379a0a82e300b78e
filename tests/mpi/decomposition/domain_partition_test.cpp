#include "decomposition/domain_partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace sphdrop {
namespace {

constexpr double cell_size = 0.4;

struct Points {
  std::vector<double> x, y;
  std::vector<std::int32_t> load;
  void add(double px, double py, std::int32_t points_load = 1) {
    x.push_back(px);
    y.push_back(py);
    load.push_back(points_load);
  }
  std::size_t size() const { return x.size(); }
};

/// A disc above a strip, from x = -3 to 3, as droplet and beam are; moved by (dx, dy).
Points disc_and_strip(double dx = 0, double dy = 0) {
  Points points;
  for (int i = -30; i <= 30; ++i)
    for (int j = -20; j <= 20; ++j) {
      const double x = 0.1 * i + 0.013;
      const double y = 0.1 * j + 0.027;
      if (x * x + y * y < 1) points.add(x + dx, y + 1.5 + dy, 2);
      if (j <= 3 && j >= 0) points.add(x, y);
    }
  return points;
}

class DomainPartitionTest : public testing::Test {
 protected:
  int rank() const { return communicator.rank(); }
  int size() const { return communicator.size(); }

  /// This rank's share of points that every rank of the test knows.
  template <class Holder>
  Points share(const Points& all, Holder holder) const {
    Points mine;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (holder(i) == rank()) mine.add(all.x[i], all.y[i], all.load[i]);
    return mine;
  }
  Points share_by_owner(const DomainPartition& partition, const Points& all) const {
    return share(all, [&](std::size_t i) { return partition.owner_of(all.x[i], all.y[i]); });
  }
  static void update(DomainPartition& partition, const Points& mine, bool force = false) {
    partition.update(mine.x, mine.y, mine.load, force);
  }
  /// Owners of all points, checked to be the same on every rank.
  std::vector<int> owners(const DomainPartition& partition, const Points& all) const {
    std::vector<int> result;
    for (std::size_t i = 0; i < all.size(); ++i) {
      result.push_back(partition.owner_of(all.x[i], all.y[i]));
      EXPECT_TRUE(result.back() >= 0 && result.back() < size());
    }
    std::vector<int> first = result;
    communicator.broadcast(first, 0);
    EXPECT_EQ(result, first);
    return result;
  }
  double imbalance(const Points& all, const std::vector<int>& owner) const {
    std::vector<double> load(static_cast<std::size_t>(size()), 0);
    double sum = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      load[static_cast<std::size_t>(owner[i])] += all.load[i];
      sum += all.load[i];
    }
    return *std::max_element(load.begin(), load.end()) * size() / sum;
  }

  /// Whoever has a point within reach is named; whoever is named has one at most a cell's diagonal further away.
  void check_other_ranks(const DomainPartition& partition, const Points& all, const std::vector<int>& owner,
                         double reach) const {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (owner[i] != rank()) continue;
      std::vector<int> answer;
      partition.other_ranks_within(all.x[i], all.y[i], reach, answer);
      EXPECT_TRUE(std::is_sorted(answer.begin(), answer.end()));
      EXPECT_EQ(std::adjacent_find(answer.begin(), answer.end()), answer.end());
      EXPECT_EQ(std::count(answer.begin(), answer.end(), rank()), 0);
      std::vector<double> nearest(static_cast<std::size_t>(size()), 1e9);
      for (std::size_t j = 0; j < all.size(); ++j) {
        double& d = nearest[static_cast<std::size_t>(owner[j])];
        d = std::min(d, std::hypot(all.x[i] - all.x[j], all.y[i] - all.y[j]));
      }
      for (int r = 0; r < size(); ++r) {
        if (r == rank()) continue;
        const bool named = std::binary_search(answer.begin(), answer.end(), r);
        const double distance = nearest[static_cast<std::size_t>(r)];
        EXPECT_TRUE(named || distance > reach) << r << " at " << distance;
        EXPECT_TRUE(!named || distance <= reach + 1.5 * cell_size) << r << " at " << distance;
      }
    }
  }

  Communicator communicator{MPI_COMM_WORLD};
};

TEST_F(DomainPartitionTest, BalancesPointsHoweverTheyAreSpreadAtFirst) {
  const Points all = disc_and_strip();
  std::mt19937 random(8);
  const auto on_last_rank = [&](std::size_t) { return size() - 1; };
  const auto round_robin = [&](std::size_t i) { return static_cast<int>(i % static_cast<std::size_t>(size())); };
  const auto at_random = [&](std::size_t) { return static_cast<int>(random() % static_cast<unsigned>(size())); };
  for (const Points& mine : {share(all, on_last_rank), share(all, round_robin), share(all, at_random), all}) {
    DomainPartition partition(communicator, cell_size, 1.1);
    update(partition, mine);
    const auto owner = owners(partition, all);
    EXPECT_LE(imbalance(all, owner), 1.35);
    EXPECT_NEAR(partition.quality().imbalance, imbalance(all, owner), 1e-12);
    EXPECT_EQ(partition.quality().repartitions, size() > 1 ? 1 : 0);
    for (int r = 0; r < size(); ++r) EXPECT_NE(std::count(owner.begin(), owner.end(), r), 0) << r;
  }
}

TEST_F(DomainPartitionTest, CountsCellsAndCutEdges) {
  // Two by three cells of one point each: eleven edges with the diagonals.
  Points all;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j) all.add((i + 0.5) * cell_size, (j - 1.5) * cell_size);
  DomainPartition partition(communicator, cell_size, 1.1);
  update(partition, rank() == 0 ? all : Points{});
  EXPECT_EQ(partition.quality().occupied_cells, 6);
  const auto owner = owners(partition, all);
  std::int64_t edges = 0;
  std::int64_t cut = 0;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (std::hypot(all.x[a] - all.x[b], all.y[a] - all.y[b]) < 1.5 * cell_size) {
        ++edges;
        if (owner[a] != owner[b]) ++cut;
      }
  EXPECT_EQ(edges, 11);
  EXPECT_EQ(partition.quality().cut_edges, cut);
  if (size() >= 6) {
    EXPECT_EQ(cut, 11);
  }
  if (size() == 1) {
    EXPECT_EQ(cut, 0);
  }
  if (size() == 2) {
    EXPECT_EQ(imbalance(all, owner), 1);
  }
}

TEST_F(DomainPartitionTest, WorksWithoutPointsAndWithFewerCellsThanRanks) {
  DomainPartition partition(communicator, cell_size, 1.1);
  update(partition, {});
  update(partition, {}, true);
  EXPECT_EQ(partition.quality().occupied_cells, 0);
  EXPECT_EQ(partition.quality().imbalance, 1);
  std::vector<int> nobody;
  partition.other_ranks_within(0, 0, 10, nobody);
  EXPECT_TRUE(nobody.empty());

  Points two;
  two.add(0.1, 0.1, 5);
  two.add(0.9, 0.1, 5);
  for (int k = 0; k < 5; ++k) update(partition, rank() == size() - 1 ? two : Points{});
  const auto owner = owners(partition, two);
  EXPECT_EQ(partition.quality().occupied_cells, 2);
  EXPECT_EQ(partition.quality().imbalance, std::max(1.0, size() / 2.0));
  if (size() > 1) {
    EXPECT_NE(owner[0], owner[1]);
  }
  // The last rank holds everything: it keeps one of the two cells, and nothing is gained by trying again.
  EXPECT_TRUE(owner[0] == size() - 1 || owner[1] == size() - 1);
  EXPECT_EQ(partition.quality().repartitions, size() > 1 ? 1 : 0);

  update(partition, {});
  EXPECT_EQ(partition.quality().occupied_cells, 0);
}

TEST_F(DomainPartitionTest, PointsWithoutLoadAreSpreadToo) {
  Points all = disc_and_strip();
  all.load.assign(all.size(), 0);
  DomainPartition partition(communicator, cell_size, 1.1);
  update(partition, rank() == 0 ? all : Points{});
  all.load.assign(all.size(), 1);
  EXPECT_LE(imbalance(all, owners(partition, all)), 2);
}

TEST_F(DomainPartitionTest, CellsKeepTheirOwnersWhileBalanced) {
  const Points all = disc_and_strip();
  DomainPartition partition(communicator, cell_size, 1.5);
  update(partition, rank() == 0 ? all : Points{});
  const auto before = owners(partition, all);
  // Who holds the points does not matter for cells known.
  for (int shift = 0; shift < 3; ++shift) {
    update(partition,
           share(all, [&](std::size_t i) { return static_cast<int>(i + static_cast<std::size_t>(shift)) % size(); }));
    EXPECT_EQ(owners(partition, all), before);
  }
  EXPECT_EQ(partition.quality().repartitions, size() > 1 ? 1 : 0);
}

TEST_F(DomainPartitionTest, NewCellsGoToTheLowestRankThatHoldsAPointThere) {
  const Points all = disc_and_strip();
  DomainPartition partition(communicator, cell_size, 3);
  update(partition, rank() == 0 ? all : Points{});
  const Points settled = share_by_owner(partition, all);

  const int lowest = std::min(1, size() - 1);
  Points with_visitors = settled;
  if (rank() >= lowest) with_visitors.add(10.1, 10.1);
  update(partition, with_visitors);
  EXPECT_EQ(partition.owner_of(10.1, 10.1), lowest);
  // It keeps its owner when only another rank is left in it ...
  with_visitors = settled;
  if (rank() == 0) with_visitors.add(10.1, 10.1);
  update(partition, with_visitors);
  EXPECT_EQ(partition.owner_of(10.1, 10.1), lowest);
  // ... and is forgotten once it was empty.
  update(partition, settled);
  with_visitors = settled;
  if (rank() == 0) with_visitors.add(10.1, 10.1);
  update(partition, with_visitors);
  EXPECT_EQ(partition.owner_of(10.1, 10.1), 0);
  EXPECT_EQ(partition.quality().repartitions, size() > 1 ? 1 : 0);
}

TEST_F(DomainPartitionTest, RepartitionsOnDemandAndWhenOutOfBalance) {
  Points all = disc_and_strip();
  DomainPartition partition(communicator, cell_size, 1.4);
  update(partition, rank() == 0 ? all : Points{});
  const std::int64_t once = size() > 1 ? 1 : 0;
  update(partition, share_by_owner(partition, all), true);
  EXPECT_EQ(partition.quality().repartitions, 2 * once);

  // What rank 0 owns becomes ten times as dear.
  const auto owner = owners(partition, all);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (owner[i] == 0) all.load[i] *= 10;
  const double before = imbalance(all, owner);
  update(partition, share_by_owner(partition, all));
  const double after = imbalance(all, owners(partition, all));
  if (size() > 1) {
    EXPECT_GT(before, 1.4);
    EXPECT_LT(after, before - 0.1);
  }
  EXPECT_EQ(partition.quality().repartitions, 3 * once);
}

TEST_F(DomainPartitionTest, DoesNotTryAgainAndAgainWhatCannotBeImproved) {
  // Cells of such different weight that no partition keeps within 1.01.
  Points all;
  for (int i = 0; i < 9; ++i) all.add((i + 0.5) * cell_size, 0, 100 + 37 * (i % 4));
  DomainPartition partition(communicator, cell_size, 1.01);
  update(partition, rank() == 0 ? all : Points{});
  for (int k = 0; k < 200; ++k) update(partition, share_by_owner(partition, all));
  if (size() > 1) {
    EXPECT_GT(partition.quality().imbalance, 1.01);
  }
  EXPECT_LE(partition.quality().repartitions, 8);
}

TEST_F(DomainPartitionTest, FollowsPointsThatMove) {
  DomainPartition partition(communicator, cell_size, 1.2);
  Points all = disc_and_strip();
  update(partition, share(all, [&](std::size_t i) { return static_cast<int>(i) % size(); }));
  std::vector<int> holder = owners(partition, all);
  for (int step = 1; step <= 60; ++step) {
    all = disc_and_strip(0.05 * step, -0.02 * step);
    update(partition, share(all, [&](std::size_t i) { return holder[i]; }));
    holder = owners(partition, all);
    // The granularity of a cell is what remains.
    EXPECT_LE(imbalance(all, holder), 1.6) << step;
    if (step % 5 == 0) check_other_ranks(partition, all, holder, 0.3);
  }
  if (size() > 1) {
    EXPECT_GT(partition.quality().repartitions, 1);
  }
  EXPECT_LT(partition.quality().repartitions, 45);
}

TEST_F(DomainPartitionTest, KnowsEveryRankWhoseCellsAreWithinReach) {
  const Points all = disc_and_strip();
  DomainPartition partition(communicator, cell_size, 1.1);
  update(partition, rank() == 0 ? all : Points{});
  const auto owner = owners(partition, all);
  for (const double reach : {0.15, 0.4, 1.0, 2.7}) check_other_ranks(partition, all, owner, reach);
}

TEST_F(DomainPartitionTest, ReportsABadPositionOnAllRanks) {
  DomainPartition partition(communicator, cell_size, 1.1);
  for (const double bad : {std::nan(""), 1e30}) {
    Points mine = disc_and_strip();
    if (rank() == size() - 1) mine.add(0.5, bad);
    EXPECT_THROW(update(partition, mine), std::runtime_error);
  }
  update(partition, disc_and_strip());
  EXPECT_GT(partition.quality().occupied_cells, 0);
}

TEST(CellsEdge, LeavesEachRankItsCells) {
  for (const int ranks : {1, 2, 3, 16, 1000, 100000}) {
    // Up to four times as many, the cells stay as they are.
    for (const double cells : {0.0, 1.0, 256.0 * ranks, 1023.9 * ranks})
      EXPECT_EQ(cells_edge(cells, ranks, 256, 0.3), 0.3);
    double last = 0;
    for (double cells = 1024.0 * ranks; cells < 1e12; cells *= 1.7) {
      const double edge = cells_edge(cells, ranks, 256, 0.3);
      const double multiple = edge / 0.3;
      int exponent = 0;
      EXPECT_EQ(std::frexp(multiple, &exponent), 0.5) << "a power of two, not " << multiple;
      EXPECT_GE(multiple, 2);
      EXPECT_GE(edge, last);
      last = edge;
      const double left = cells / (multiple * multiple) / ranks;
      EXPECT_TRUE(left >= 256 && left < 1024) << left << " of " << cells << " on " << ranks;
    }
  }
  EXPECT_EQ(cells_edge(40, 2, 5, 1.0), 2.0);
  EXPECT_EQ(cells_edge(39, 2, 5, 1.0), 1.0);
  EXPECT_EQ(cells_edge(1e300, 1, 1, 1.0), 1 << 20) << "it ends";
}

TEST_F(DomainPartitionTest, RefusesImpossibleSettings) {
  EXPECT_THROW(DomainPartition(communicator, 0, 1.1), std::invalid_argument);
  EXPECT_THROW(DomainPartition(communicator, std::nan(""), 1.1), std::invalid_argument);
  EXPECT_THROW(DomainPartition(communicator, 1, 0.9), std::invalid_argument);
}

TEST_F(DomainPartitionTest, HugeLoadsDoNotOverflow) {
  Points all = disc_and_strip();
  for (std::int32_t& load : all.load) load *= 1000000000;
  DomainPartition partition(communicator, cell_size, 1.1);
  update(partition, share(all, [&](std::size_t i) { return static_cast<int>(i) % size(); }));
  EXPECT_LE(imbalance(all, owners(partition, all)), 1.35);
}

}  // namespace
}  // namespace sphdrop
