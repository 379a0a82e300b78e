#pragma once
// The cells that a rank computes, laid out for vector loads.

#include <array>
#include <cstdint>
#include <vector>

#include "particles/solid_particles.hpp"
#include "solid/cells/lattice_cells.hpp"

namespace sphdrop {

/// A cell is kept in the row of its south-west corner. Rows being sorted by id, and ids running up the lattice's
/// columns, its north-west corner is the next row, and the eastern corners lie a fixed number of rows on for long runs
/// of cells: all loads are contiguous. A rank has the cells with at least one corner that it owns.
class CellMesh {
 public:
  /// Consecutive cells; rows among them that are no cell have a shape of area 0.
  struct CellRun {
    std::int32_t begin = 0, end = 0;  ///< rows
    std::int32_t east = 0;            ///< rows from a western corner to the eastern one beside it
    bool needs_ghosts = false;
  };
  /// Consecutive owned particles.
  struct ParticleRun {
    std::int32_t begin = 0, end = 0;
    std::int32_t west = 0;  ///< rows back to the western neighbours; 0: they have none
  };

  CellMesh() = default;
  /// `particles` sorted by id, of this body and perhaps of others, with ghosts one lattice diagonal about the owned
  /// ones; `first_id` is the id of the lattice's particle 0.
  CellMesh(const ParticleSet& particles, const LatticeCells& lattice, std::int64_t first_id);

  const std::vector<CellRun>& cell_runs() const { return cell_runs_; }
  const std::vector<ParticleRun>& particle_runs() const { return particle_runs_; }
  CellShape<double> shape(std::int32_t row) const;
  bool is_cell(std::int32_t row) const { return shape_[0][static_cast<std::size_t>(row)] > 0; }
  /// Members of CellShape, in their order, by row.
  const std::array<Column<double>, 7>& shape_columns() const { return shape_; }

 private:
  std::array<Column<double>, 7> shape_;
  std::vector<CellRun> cell_runs_;
  std::vector<ParticleRun> particle_runs_;
};

}  // namespace sphdrop
