#pragma once
// Which other ranks own something near a point.

#include <cstdint>
#include <vector>

#include "decomposition/cell_index.hpp"

namespace sphdrop {

/// The occupied cells and, by their number, who owns them.
struct CellOwners {
  CellIndex index;
  std::vector<int> owners;
};

/// Answers "who else has a cell within reach of this point" for many points in turn. For each own cell it remembers the
/// foreign cells that any point of it can reach: none for the interior, where the answer is one look-up.
class NeighbourRanks {
 public:
  explicit NeighbourRanks(int own_rank) : own_rank_(own_rank) {}

  /// To be called whenever the table has changed.
  void forget() { ++version_; }

  /// Appends to `ranks`, ascending and once each, the other ranks with a cell within `reach` of the point (u, v);
  /// lengths in units of the cell size. The reach is widened by a few rounding errors of the coordinates.
  void append(const CellOwners& table, double u, double v, double reach, std::vector<int>& ranks);

 private:
  struct ForeignCell {
    Cell cell;
    int owner = 0;
  };
  /// The foreign cells within reach of some point of one cell, by owner, the nearest first.
  struct Surroundings {
    std::uint64_t version = 0;
    std::vector<ForeignCell> foreign;
  };
  void collect(const CellOwners& table, Cell centre, std::vector<ForeignCell>& foreign) const;

  int own_rank_;
  double reach_ = -1;
  std::uint64_t version_ = 0;
  std::vector<Surroundings> of_cell_;
  Surroundings elsewhere_;
};

}  // namespace sphdrop
