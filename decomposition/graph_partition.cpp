// METIS behind guards.

#include <metis.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <csignal>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>

#include "decomposition/domain_partition.hpp"
#include "decomposition/signal_block.hpp"

namespace sphdrop {
namespace {

static_assert(sizeof(idx_t) == sizeof(std::int32_t), "METIS must be built with 32-bit indices");

/// METIS recommends recursive bisection for few parts (its manual, Sec. 3.1): it balances them better.
constexpr int most_parts_by_bisection = 8;
/// The best cut of so many partitions that METIS makes.
constexpr idx_t attempts = 4;
constexpr idx_t seed = 20;

/// METIS installs handlers of its own for SIGTERM and SIGABRT and puts the old ones back by signal(), which loses flags
/// and mask; while its handlers are in place no signal may arrive, or it is swallowed with the partition half made.
class MetisSignalGuard {
 public:
  MetisSignalGuard() {
    sigaction(SIGTERM, nullptr, &on_term_);
    sigaction(SIGABRT, nullptr, &on_abort_);
  }
  ~MetisSignalGuard() {
    sigaction(SIGTERM, &on_term_, nullptr);
    sigaction(SIGABRT, &on_abort_, nullptr);
  }
  MetisSignalGuard(const MetisSignalGuard&) = delete;
  MetisSignalGuard& operator=(const MetisSignalGuard&) = delete;

 private:
  SignalBlock block_;  // first in, last out: what is pending meets the handlers of old
  struct sigaction on_term_ = {}, on_abort_ = {};
};

std::vector<std::int32_t> run_metis(std::span<const std::int32_t> row_starts, std::span<const std::int32_t> neighbours,
                                    std::span<const std::int32_t> vertex_weights,
                                    std::span<const std::int32_t> edge_weights, int parts) {
  auto vertices = static_cast<idx_t>(row_starts.size() - 1);
  idx_t constraints = 1;
  idx_t part_count = parts;
  idx_t cut = 0;
  // METIS takes pointers to non-const and says that it leaves the graph alone: it gets copies all the same.
  std::vector<idx_t> starts(row_starts.begin(), row_starts.end());
  std::vector<idx_t> targets(neighbours.begin(), neighbours.end());
  std::vector<idx_t> vertex(vertex_weights.begin(), vertex_weights.end());
  std::vector<idx_t> edge(edge_weights.begin(), edge_weights.end());
  targets.reserve(1);  // a graph without edges still needs a pointer
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = seed;
  options[METIS_OPTION_NCUTS] = attempts;
  const auto partition = parts <= most_parts_by_bisection ? METIS_PartGraphRecursive : METIS_PartGraphKway;

  std::vector<idx_t> part(static_cast<std::size_t>(vertices));
  int status = METIS_ERROR;
  {
    const MetisSignalGuard guard;
    status = partition(&vertices, &constraints, starts.data(), targets.data(), vertex.empty() ? nullptr : vertex.data(),
                       nullptr, edge.empty() ? nullptr : edge.data(), &part_count, nullptr, nullptr, options.data(),
                       &cut, part.data());
  }
  if (status != METIS_OK)
    throw std::runtime_error("METIS could not partition a graph of " + std::to_string(vertices) + " cells into " +
                             std::to_string(parts) + " parts (status " + std::to_string(status) + ")");
  return {part.begin(), part.end()};
}

/// Cuts the vertices, in the order given, into so many runs, none empty, that the heaviest is as light as can be.
std::vector<std::int32_t> partition_chain(std::span<const std::int32_t> weights, int parts) {
  // Fills runs up to a limit, leaving a vertex for each part to come. Returns the runs needed.
  std::vector<std::int32_t> part(weights.size());
  const auto fill = [&](std::int64_t limit) {
    std::int32_t run = 0;
    std::int64_t load = 0;
    for (std::size_t v = 0; v < weights.size(); ++v) {
      const auto parts_to_come = static_cast<std::int64_t>(parts) - 1 - run;
      const auto vertices_left = static_cast<std::int64_t>(weights.size() - v);
      if (v > 0 && (load + weights[v] > limit || vertices_left <= parts_to_come)) {
        ++run;
        load = 0;
      }
      load += weights[v];
      part[v] = run;
    }
    return run + 1;
  };
  std::int64_t enough = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  std::int64_t least = *std::max_element(weights.begin(), weights.end());
  while (least < enough) {
    const std::int64_t middle = std::midpoint(least, enough);
    if (fill(middle) <= parts)
      enough = middle;
    else
      least = middle + 1;
  }
  fill(enough);
  return part;
}

bool has_empty_part(std::span<const std::int32_t> part, int parts) {
  std::vector<bool> is_used(static_cast<std::size_t>(parts), false);
  for (const std::int32_t p : part) is_used[static_cast<std::size_t>(p)] = true;
  return std::find(is_used.begin(), is_used.end(), false) != is_used.end();
}

/// METIS leaves parts empty, and says so on the standard output, where there are few vertices a part or one outweighs a
/// part's share.
bool is_too_coarse_for_metis(std::span<const std::int32_t> weights, int parts) {
  constexpr std::size_t fewest_vertices_per_part = 6;
  const std::int64_t sum = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
  const std::int64_t heaviest = *std::max_element(weights.begin(), weights.end());
  return weights.size() < fewest_vertices_per_part * static_cast<std::size_t>(parts) || heaviest * parts > sum;
}

}  // namespace

std::vector<std::int32_t> partition_graph(std::span<const std::int32_t> row_starts,
                                          std::span<const std::int32_t> neighbours,
                                          std::span<const std::int32_t> vertex_weights,
                                          std::span<const std::int32_t> edge_weights, int parts) {
  if (parts < 1) throw std::invalid_argument("a graph cannot be split into " + std::to_string(parts) + " parts");
  const std::size_t vertices = row_starts.empty() ? 0 : row_starts.size() - 1;
  assert(vertex_weights.empty() || vertex_weights.size() == vertices);
  assert(edge_weights.empty() || edge_weights.size() == neighbours.size());
  std::vector<std::int32_t> part(vertices, 0);
  if (parts == 1 || vertices == 0) return part;
  if (static_cast<std::size_t>(parts) >= vertices) {
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  // Without any weight METIS divides by zero; counting vertices is as good as anything then.
  std::vector<std::int32_t> weights(vertex_weights.begin(), vertex_weights.end());
  if (std::all_of(weights.begin(), weights.end(), [](std::int32_t w) { return w == 0; })) weights.assign(vertices, 1);
  if (is_too_coarse_for_metis(weights, parts)) return partition_chain(weights, parts);
  part = run_metis(row_starts, neighbours, weights, edge_weights, parts);
  if (has_empty_part(part, parts)) return partition_chain(weights, parts);
  return part;
}

}  // namespace sphdrop
