#include "decomposition/domain_partition.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace sphdrop {
namespace {

/// Half of a cell's eight neighbours: each pair of neighbours once.
constexpr Cell forward_neighbours[] = {{0, 1}, {1, -1}, {1, 0}, {1, 1}};

/// Updates to wait after METIS has failed to reach the threshold; doubled whenever it fails to improve at all.
constexpr int shortest_wait = 8;
constexpr int longest_wait = 1024;

/// METIS adds weights up in 32 bits.
constexpr std::int64_t largest_weight_sum = 1 << 30;

/// A weight on a scale where all weights together fit, never rounded down to nothing.
std::int32_t scaled_weight(std::int64_t weight, std::int64_t sum) {
  if (sum <= largest_weight_sum) return static_cast<std::int32_t>(weight);
  if (weight == 0) return 0;
  const double scale = static_cast<double>(largest_weight_sum) / static_cast<double>(sum);
  return std::max(1, static_cast<std::int32_t>(static_cast<double>(weight) * scale));
}

template <class Visit>
void for_each_edge(const CellIndex& index, Visit visit) {
  for (std::size_t a = 0; a < index.size(); ++a)
    for (const Cell step : forward_neighbours) {
      const Cell cell = index.cells()[a];
      const std::int32_t b = index.find({cell.column + step.column, cell.row + step.row});
      if (b != CellIndex::absent) visit(a, static_cast<std::size_t>(b));
    }
}

}  // namespace

double cells_edge(double least_cells, int ranks, std::int64_t cells_per_rank, double least_edge) {
  assert(ranks >= 1 && cells_per_rank >= 1 && least_edge > 0);
  // Beyond that edge everything is in one cell anyway; it also ends the loop for any number.
  constexpr double largest_multiple = 1 << 20;
  const double wanted = static_cast<double>(cells_per_rank) * ranks;
  double multiple = 1;
  while (multiple < largest_multiple && least_cells >= wanted * (2 * multiple) * (2 * multiple)) multiple *= 2;
  return multiple * least_edge;
}

DomainPartition::DomainPartition(const Communicator& communicator, double cell_size, double imbalance_threshold)
    : communicator_(&communicator),
      cell_size_(cell_size),
      threshold_(imbalance_threshold),
      neighbour_ranks_(communicator.rank()) {
  if (!(cell_size > 0) || !std::isfinite(cell_size))
    throw std::invalid_argument("the cells of the domain partition must be larger than 0 m, not " +
                                std::to_string(cell_size));
  if (!(imbalance_threshold >= 1) || !std::isfinite(imbalance_threshold))
    throw std::invalid_argument("the imbalance that triggers a new partition must be at least 1, not " +
                                std::to_string(imbalance_threshold));
}

void DomainPartition::update(std::span<const double> x, std::span<const double> y, std::span<const std::int32_t> load,
                             bool force) {
  merge(communicator_->all_gather<Contribution>(own_contributions(x, y, load)));
  quality_.imbalance = imbalance_of(table_.owners);
  if (table_.index.size() > 0 && communicator_->size() > 1) {
    if (force || !is_partitioned_)
      repartition(true);
    else if (repartition_is_due())
      repartition(false);
    else
      ++updates_waited_;
  }
  quality_.occupied_cells = static_cast<std::int64_t>(table_.index.size());
  quality_.cut_edges = cut_edges();
  neighbour_ranks_.forget();
}

std::vector<DomainPartition::Contribution> DomainPartition::own_contributions(
    std::span<const double> x, std::span<const double> y, std::span<const std::int32_t> load) const {
  assert(x.size() == y.size() && x.size() == load.size());
  CellIndex index;
  std::vector<Contribution> contributions;
  std::string error;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = x[i] / cell_size_;
    const double v = y[i] / cell_size_;
    if (!is_in_a_cell(u, v)) {
      error = "a point at (" + std::to_string(x[i]) + ", " + std::to_string(y[i]) +
              ") m is not finite or too far away to be assigned to a rank";
      break;
    }
    assert(load[i] >= 0);
    const auto number = static_cast<std::size_t>(index.insert(cell_at(u, v)));
    if (number == contributions.size()) contributions.push_back({cell_at(u, v), 0, 0, communicator_->rank()});
    contributions[number].load += load[i];
    ++contributions[number].points;
  }
  // All ranks must throw together: the others would wait for this one otherwise.
  const std::int64_t nobody = communicator_->size();
  const std::int64_t first = communicator_->min(error.empty() ? nobody : std::int64_t{communicator_->rank()});
  if (first != nobody) {
    communicator_->broadcast(error, static_cast<int>(first));
    throw std::runtime_error(error);
  }
  return contributions;
}

void DomainPartition::merge(std::vector<Contribution> contributions) {
  std::sort(contributions.begin(), contributions.end(), [](const Contribution& a, const Contribution& b) {
    return std::tie(a.cell, a.rank) < std::tie(b.cell, b.rank);
  });
  const CellOwners before = std::exchange(table_, {});
  contents_.clear();
  for (const Contribution& c : contributions) {
    const auto number = static_cast<std::size_t>(table_.index.insert(c.cell));
    if (number == contents_.size()) {
      const std::int32_t known = before.index.find(c.cell);
      table_.owners.push_back(known == CellIndex::absent ? c.rank : before.owners[static_cast<std::size_t>(known)]);
      contents_.emplace_back();
    }
    contents_[number].load += c.load;
    contents_[number].points += c.points;
  }
}

bool DomainPartition::repartition_is_due() const {
  if (quality_.imbalance <= threshold_) return false;
  // No partition can be better balanced than the heaviest cell alone allows.
  std::int64_t sum = 0;
  std::int64_t heaviest = 0;
  for (const CellContent& content : contents_) {
    sum += content.load;
    heaviest = std::max(heaviest, content.load);
  }
  if (quality_.imbalance * static_cast<double>(sum) <= static_cast<double>(heaviest) * communicator_->size())
    return false;
  // METIS will hardly do better than last time: an imbalance not clearly above that is put up with for a while.
  const double tolerated = threshold_ - 1;
  return quality_.imbalance > reached_imbalance_ + 0.5 * tolerated || updates_waited_ >= updates_to_wait_;
}

void DomainPartition::repartition(bool always_adopt) {
  const std::vector<int> owners = owners_of_parts(partition_on_one_rank());
  ++quality_.repartitions;
  is_partitioned_ = true;
  reached_imbalance_ = imbalance_of(owners);
  updates_waited_ = 0;
  // What little would be gained is not worth moving points for.
  const bool improves = reached_imbalance_ < quality_.imbalance - 0.25 * (threshold_ - 1);
  if (improves || always_adopt) {
    table_.owners = owners;
    quality_.imbalance = reached_imbalance_;
    updates_to_wait_ = shortest_wait;
  } else {
    updates_to_wait_ = std::min(2 * updates_to_wait_, longest_wait);
  }
}

std::vector<std::int32_t> DomainPartition::partition_on_one_rank() const {
  std::vector<std::int32_t> parts;
  std::string error;
  if (communicator_->rank() == 0) {
    try {
      parts = partition_cells();
    } catch (const std::exception& e) {
      error = e.what();
    }
  }
  communicator_->broadcast(error, 0);
  if (!error.empty()) throw std::runtime_error(error);
  communicator_->broadcast(parts, 0);
  return parts;
}

std::vector<std::int32_t> DomainPartition::partition_cells() const {
  const CellIndex& index = table_.index;
  std::int64_t load_sum = 0;
  std::int64_t point_sum = 0;
  for (const CellContent& content : contents_) {
    load_sum += content.load;
    point_sum += content.points;
  }
  std::vector<std::int32_t> weights;
  for (const CellContent& content : contents_) weights.push_back(scaled_weight(content.load, load_sum));

  struct Edge {
    std::int32_t from, to, weight;
  };
  std::vector<Edge> edges;
  for_each_edge(index, [&](std::size_t a, std::size_t b) {
    // Were the two cells on different ranks, the points of each would have to travel to the other's.
    const std::int32_t weight = scaled_weight(contents_[a].points + contents_[b].points, 16 * point_sum);
    edges.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), weight});
    edges.push_back({static_cast<std::int32_t>(b), static_cast<std::int32_t>(a), weight});
  });
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  std::vector<std::int32_t> row_starts(index.size() + 1, 0);
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> edge_weights;
  for (const Edge& edge : edges) {
    ++row_starts[static_cast<std::size_t>(edge.from) + 1];
    neighbours.push_back(edge.to);
    edge_weights.push_back(edge.weight);
  }
  for (std::size_t a = 0; a < index.size(); ++a) row_starts[a + 1] += row_starts[a];
  return partition_graph(row_starts, neighbours, weights, edge_weights, communicator_->size());
}

std::vector<int> DomainPartition::owners_of_parts(std::span<const std::int32_t> parts) const {
  // METIS numbers parts as it likes: each goes to the rank that owns most of it already, so that few points move.
  struct Overlap {
    std::int32_t part;
    int rank;
    std::int64_t load;
  };
  std::vector<Overlap> overlaps;
  for (std::size_t a = 0; a < parts.size(); ++a) overlaps.push_back({parts[a], table_.owners[a], contents_[a].load});
  const auto pair = [](const Overlap& o) { return std::tie(o.part, o.rank); };
  std::sort(overlaps.begin(), overlaps.end(), [&](const auto& a, const auto& b) { return pair(a) < pair(b); });
  std::vector<Overlap> merged;
  for (const Overlap& o : overlaps) {
    if (merged.empty() || pair(merged.back()) != pair(o))
      merged.push_back(o);
    else
      merged.back().load += o.load;
  }
  std::stable_sort(merged.begin(), merged.end(), [](const auto& a, const auto& b) { return a.load > b.load; });

  constexpr int none = -1;
  const auto ranks = static_cast<std::size_t>(communicator_->size());
  std::vector<int> rank_of_part(ranks, none);
  std::vector<bool> is_taken(ranks, false);
  const auto assign = [&](std::size_t part, std::size_t rank) {
    if (rank_of_part[part] != none || is_taken[rank]) return;
    rank_of_part[part] = static_cast<int>(rank);
    is_taken[rank] = true;
  };
  for (const Overlap& o : merged) assign(static_cast<std::size_t>(o.part), static_cast<std::size_t>(o.rank));
  // Parts and ranks that are left are equally many: the lowest of each go together.
  for (std::size_t part = 0, rank = 0; part < ranks; ++part) {
    if (rank_of_part[part] != none) continue;
    while (is_taken[rank]) ++rank;
    assign(part, rank);
  }

  std::vector<int> owners;
  for (const std::int32_t part : parts) owners.push_back(rank_of_part[static_cast<std::size_t>(part)]);
  return owners;
}

double DomainPartition::imbalance_of(std::span<const int> owners) const {
  std::vector<std::int64_t> loads(static_cast<std::size_t>(communicator_->size()), 0);
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < owners.size(); ++a) {
    loads[static_cast<std::size_t>(owners[a])] += contents_[a].load;
    sum += contents_[a].load;
  }
  if (sum == 0) return 1;
  return static_cast<double>(*std::max_element(loads.begin(), loads.end())) * communicator_->size() /
         static_cast<double>(sum);
}

std::int64_t DomainPartition::cut_edges() const {
  std::int64_t count = 0;
  for_each_edge(table_.index, [&](std::size_t a, std::size_t b) {
    if (table_.owners[a] != table_.owners[b]) ++count;
  });
  return count;
}

int DomainPartition::owner_of(double x, double y) const {
  const std::int32_t number = table_.index.find(cell_at(x / cell_size_, y / cell_size_));
  assert(number != CellIndex::absent);
  return table_.owners[static_cast<std::size_t>(number)];
}

void DomainPartition::other_ranks_within(double x, double y, double reach, std::vector<int>& ranks) const {
  if (communicator_->size() == 1) return;
  neighbour_ranks_.append(table_, x / cell_size_, y / cell_size_, reach / cell_size_, ranks);
}

}  // namespace sphdrop
