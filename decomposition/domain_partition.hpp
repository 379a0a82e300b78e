#pragma once
// Which rank owns which part of the plane.

#include <cstdint>
#include <span>
#include <vector>

#include "decomposition/cell_index.hpp"
#include "decomposition/communicator.hpp"
#include "decomposition/neighbour_ranks.hpp"

namespace sphdrop {

/// How good a partition is, for the report.
struct PartitionQuality {
  double imbalance = 1.0;           ///< largest load of a rank over the mean load
  std::int64_t occupied_cells = 0;  ///< vertices of the graph
  std::int64_t cut_edges = 0;       ///< edges between cells of different ranks
  std::int64_t repartitions = 0;    ///< how often METIS has run
};

/// The edge of the cells for a partition among `ranks`, in the unit of `least_edge`: the largest power of two times
/// `least_edge` with which `least_cells` cells of `least_edge` still are `cells_per_rank` for each rank, or
/// `least_edge` if there are none so many. The table of cells has then between one and four times `cells_per_rank`
/// entries for each rank, however many the points are, and a cell that is full has at most one part in `cells_per_rank`
/// of a rank's share.
double cells_edge(double least_cells, int ranks, std::int64_t cells_per_rank, double least_edge);

/// The plane cut in square cells of a fixed size, the occupied ones each owned by a rank: METIS partitions the graph of
/// occupied cells (vertex weight = load of the points in it, edges to the eight neighbours weighted by the points that
/// would have to travel). The table of occupied cells is the same on every rank; cells_edge() keeps it small.
class DomainPartition {
 public:
  /// Repartitions when the largest load exceeds `imbalance_threshold` times the mean. Throws std::invalid_argument
  /// unless 0 < cell_size (m) and 1 <= imbalance_threshold, both finite. The communicator must outlive it.
  DomainPartition(const Communicator& communicator, double cell_size, double imbalance_threshold);

  /// Collective. Takes this rank's points (shapes: [n], positions in m; load in any unit, integers for exactness) and
  /// brings the table of occupied cells up to date. A cell keeps its owner; a newly occupied one goes to the lowest
  /// rank that holds a point in it; everything is repartitioned on the first call, when `force` is set, or when the
  /// imbalance passes the threshold and a new partition can improve on it. Only cells in the table count: one that was
  /// empty at one update is newly occupied at the next. Throws std::runtime_error, on all ranks, for a position that is
  /// not finite or more than 2^29 cells from the origin, and if METIS fails.
  void update(std::span<const double> x, std::span<const double> y, std::span<const std::int32_t> load, bool force);

  /// The owner of the cell at (x, y), which must be occupied (asserted).
  int owner_of(double x, double y) const;

  /// Appends, in ascending order and once each, the ranks other than this one that own a cell within `reach` of (x, y).
  /// Any reach is allowed, also beyond the cell size.
  void other_ranks_within(double x, double y, double reach, std::vector<int>& ranks) const;

  const PartitionQuality& quality() const { return quality_; }
  double cell_size() const { return cell_size_; }

 private:
  /// What all ranks together hold in a cell.
  struct CellContent {
    std::int64_t load = 0;
    std::int64_t points = 0;
  };
  /// What one rank holds in a cell.
  struct Contribution {
    Cell cell;
    std::int64_t load = 0;
    std::int32_t points = 0;
    std::int32_t rank = 0;
  };

  std::vector<Contribution> own_contributions(std::span<const double> x, std::span<const double> y,
                                              std::span<const std::int32_t> load) const;
  void merge(std::vector<Contribution> contributions);
  bool repartition_is_due() const;
  void repartition(bool always_adopt);
  std::vector<std::int32_t> partition_on_one_rank() const;
  std::vector<std::int32_t> partition_cells() const;
  std::vector<int> owners_of_parts(std::span<const std::int32_t> parts) const;
  double imbalance_of(std::span<const int> owners) const;
  std::int64_t cut_edges() const;

  const Communicator* communicator_;
  double cell_size_;
  double threshold_;
  CellOwners table_;                   ///< the same on every rank, in ascending order of the cells
  std::vector<CellContent> contents_;  ///< by cell number
  PartitionQuality quality_;
  bool is_partitioned_ = false;
  double reached_imbalance_ = 1;  ///< by the last run of METIS
  int updates_to_wait_ = 0;       ///< before METIS is tried again though it did not reach the threshold
  int updates_waited_ = 0;
  mutable NeighbourRanks neighbour_ranks_;
};

/// Splits the graph given in compressed rows (METIS' xadj, adjncy; the weights may be empty: all 1) into `parts`;
/// deterministic; guards against what METIS does not survive (one part, more parts than vertices, empty graphs). Every
/// vertex gets a part in [0, parts), and every part a vertex if there are enough. Graphs too coarse for METIS are cut
/// into runs of consecutive vertices instead: neighbours should have numbers close to each other. Throws
/// std::invalid_argument for parts < 1 and std::runtime_error if METIS fails.
std::vector<std::int32_t> partition_graph(std::span<const std::int32_t> row_starts,
                                          std::span<const std::int32_t> neighbours,
                                          std::span<const std::int32_t> vertex_weights,
                                          std::span<const std::int32_t> edge_weights, int parts);

}  // namespace sphdrop
