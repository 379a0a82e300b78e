#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "decomposition/domain_partition.hpp"

namespace sphdrop {
namespace {

struct Graph {
  std::vector<std::int32_t> row_starts{0}, neighbours, vertex_weights, edge_weights;
  std::size_t size() const { return row_starts.size() - 1; }
  std::vector<std::int32_t> partition(int parts) const {
    return partition_graph(row_starts, neighbours, vertex_weights, edge_weights, parts);
  }
};

/// A lattice with edges to the eight neighbours.
Graph lattice(std::int32_t columns, std::int32_t rows) {
  Graph graph;
  for (std::int32_t i = 0; i < columns; ++i)
    for (std::int32_t j = 0; j < rows; ++j) {
      for (std::int32_t a = std::max(i - 1, 0); a <= std::min(i + 1, columns - 1); ++a)
        for (std::int32_t b = std::max(j - 1, 0); b <= std::min(j + 1, rows - 1); ++b)
          if (a != i || b != j) graph.neighbours.push_back(a * rows + b);
      graph.row_starts.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
    }
  graph.vertex_weights.assign(graph.size(), 1);
  graph.edge_weights.assign(graph.neighbours.size(), 1);
  return graph;
}

std::vector<std::int64_t> loads(const Graph& graph, const std::vector<std::int32_t>& part, int parts) {
  std::vector<std::int64_t> load(static_cast<std::size_t>(parts), 0);
  for (std::size_t v = 0; v < part.size(); ++v) load.at(static_cast<std::size_t>(part[v])) += graph.vertex_weights[v];
  return load;
}

double imbalance(const Graph& graph, const std::vector<std::int32_t>& part, int parts) {
  const auto load = loads(graph, part, parts);
  return static_cast<double>(*std::max_element(load.begin(), load.end()) * parts) /
         static_cast<double>(std::accumulate(load.begin(), load.end(), std::int64_t{0}));
}

int cut(const Graph& graph, const std::vector<std::int32_t>& part) {
  int edges = 0;
  for (std::size_t v = 0; v < graph.size(); ++v)
    for (auto e = graph.row_starts[v]; e < graph.row_starts[v + 1]; ++e)
      if (part[v] != part[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])]) ++edges;
  return edges / 2;
}

TEST(PartitionGraph, SurvivesWhatMetisDoesNot) {
  EXPECT_TRUE(partition_graph({}, {}, {}, {}, 4).empty());
  EXPECT_TRUE(lattice(0, 0).partition(1).empty());
  EXPECT_EQ(lattice(3, 2).partition(1), std::vector<std::int32_t>(6, 0));
  EXPECT_EQ(lattice(1, 1).partition(7), std::vector<std::int32_t>{0});
  EXPECT_EQ(lattice(1, 3).partition(3), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(lattice(1, 3).partition(9), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_THROW(lattice(1, 3).partition(0), std::invalid_argument);
}

/// The least load that the heaviest of `parts` runs of consecutive vertices can have, by dynamic programming.
std::int64_t best_run_load(const std::vector<std::int32_t>& weights, int parts) {
  constexpr std::int64_t impossible = std::int64_t{1} << 60;
  std::vector<std::int64_t> best(weights.size() + 1, impossible);
  best[0] = 0;
  for (int p = 0; p < parts; ++p) {
    std::vector<std::int64_t> next(weights.size() + 1, impossible);
    for (std::size_t begin = 0; begin < weights.size(); ++begin) {
      std::int64_t load = 0;
      for (std::size_t end = begin + 1; end <= weights.size(); ++end) {
        load += weights[end - 1];
        next[end] = std::min(next[end], std::max(best[begin], load));
      }
    }
    best = next;
  }
  return best.back();
}

TEST(PartitionGraph, FewVerticesAreCutIntoTheBestRuns) {
  std::mt19937 random(9);
  for (int k = 0; k < 300; ++k) {
    const int parts = 2 + static_cast<int>(random() % 8);
    Graph graph = lattice(1, parts + static_cast<int>(random() % static_cast<unsigned>(4 * parts)));
    for (std::int32_t& weight : graph.vertex_weights) weight = static_cast<std::int32_t>(random() % 50);
    graph.vertex_weights[0] = 1;
    const auto load = loads(graph, graph.partition(parts), parts);
    ASSERT_EQ(*std::max_element(load.begin(), load.end()), best_run_load(graph.vertex_weights, parts));
  }
}

TEST(PartitionGraph, LeavesNoPartEmptyAndMetisQuiet) {
  testing::internal::CaptureStdout();
  std::mt19937 random(10);
  const auto check = [&](const Graph& graph, int parts) {
    std::vector<int> count(static_cast<std::size_t>(parts), 0);
    for (const std::int32_t p : graph.partition(parts)) ++count.at(static_cast<std::size_t>(p));
    ASSERT_GE(*std::min_element(count.begin(), count.end()), 1) << graph.size() << " vertices, " << parts << " parts";
  };
  for (const int columns : {2, 3, 5, 9, 14, 23, 37})
    for (int parts = 2; parts <= columns; parts += 1 + parts / 6)
      for (const int rows : {1, 4}) {
        Graph graph = lattice(columns, rows);
        check(graph, parts);
        for (std::int32_t& weight : graph.vertex_weights) weight = static_cast<std::int32_t>(random() % 40);
        check(graph, parts);
        graph.vertex_weights[graph.size() / 3] = 1000;
        check(graph, parts);
        graph.vertex_weights.assign(graph.size(), 0);
        graph.vertex_weights.back() = 1;
        check(graph, parts);
      }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(PartitionGraph, SplitsGraphsWithoutEdgesWeightsOrConnection) {
  Graph scattered;
  scattered.row_starts.assign(41, 0);
  scattered.vertex_weights.assign(40, 3);
  EXPECT_LE(imbalance(scattered, scattered.partition(4), 4), 1.11);

  Graph weightless = lattice(8, 8);
  weightless.vertex_weights.assign(64, 0);
  const auto part = weightless.partition(4);
  weightless.vertex_weights.assign(64, 1);
  EXPECT_LE(imbalance(weightless, part, 4), 1.13);
  EXPECT_LE(imbalance(weightless, partition_graph(weightless.row_starts, weightless.neighbours, {}, {}, 4), 4), 1.13);

  Graph islands = lattice(6, 6);
  const Graph second = lattice(5, 7);
  for (const std::int32_t n : second.neighbours) islands.neighbours.push_back(n + 36);
  const std::int32_t start = islands.row_starts.back();
  for (std::size_t v = 1; v <= second.size(); ++v) islands.row_starts.push_back(start + second.row_starts[v]);
  islands.vertex_weights.assign(islands.size(), 1);
  islands.edge_weights.assign(islands.neighbours.size(), 1);
  EXPECT_LE(imbalance(islands, islands.partition(5), 5), 1.15);
}

TEST(PartitionGraph, BalancesWeightsAndCutsFewEdges) {
  std::mt19937 random(4);
  Graph graph = lattice(100, 8);
  for (std::int32_t& weight : graph.vertex_weights) weight = 10 + static_cast<std::int32_t>(random() % 30);
  for (const int parts : {2, 3, 4, 7, 8, 12}) {
    const auto part = graph.partition(parts);
    EXPECT_LE(imbalance(graph, part, parts), 1.05) << parts;
    // Straight cuts across the strip would cost 22 edges each.
    EXPECT_LE(cut(graph, part), 32 * (parts - 1)) << parts;
  }
}

TEST(PartitionGraph, IsDeterministicWhateverTheStateOfTheRandomGenerator) {
  Graph graph = lattice(40, 30);
  for (const int parts : {2, 4, 7, 16}) {
    const auto first = graph.partition(parts);
    srand(12345);
    std::ignore = rand();
    std::ignore = lattice(13, 17).partition(5);
    EXPECT_EQ(graph.partition(parts), first) << parts;
  }
}

}  // namespace
}  // namespace sphdrop
