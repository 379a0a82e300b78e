#pragma once
// The cells of a whole body whose particles stand on a square lattice.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/column_stretch.hpp"
#include "particles/plane_moments.hpp"
#include "particles/vector.hpp"
#include "solid/cells/cell.hpp"

namespace sphdrop {

/// Every 2 x 2 block of particles is a cell. The square about each particle has four quadrants: one goes to the cell in
/// its direction; where there is none, in halves to the cells beyond its two sides, or wholly to the one of them that
/// exists, or to the particle's only cell. So the cells fill the body exactly and reach d/2 beyond the outermost
/// particles. Cells of held particles alone are left out: nothing deforms them.
class LatticeCells {
 public:
  LatticeCells() = default;

  /// `positions`: the undeformed body, column by column in ascending x, from bottom to top in a column; m. `is_held`: 1
  /// for particles that never move. `held_at_edge`: the body ends, and is held, midway between held and free particles,
  /// as in an ideal clamp; otherwise held particles are part of it. Throws std::invalid_argument if the positions are
  /// not such a lattice, or if a particle that is not held belongs to no cell.
  ///
  /// `quadrants` [particles]: what a particle has to the south-west, south-east, north-west and north-east of it, in
  /// spacings about it, where that is not a quarter of its square each. A block that has less than a quarter of a
  /// square among its four particles is no cell then: a slit runs through it.
  LatticeCells(std::span<const Vector> positions, std::span<const char> is_held, double spacing, bool held_at_edge,
               std::span<const std::array<PlaneMoments, 4>> quadrants = {});

  /// Likewise of a body of those columns. Columns that have alike ones beside them have alike cells, so that what is
  /// kept does not grow with the length of a stretch.
  LatticeCells(std::span<const ColumnStretch> columns, bool held_at_edge);

  std::size_t particle_count() const { return static_cast<std::size_t>(particle_count_); }
  /// The number of particles whose neighbours and cell are kept; those of the others are like them.
  std::size_t table_size() const { return east_.size(); }
  std::int64_t cell_count() const { return cell_count_; }
  /// The particle one column to the right or left of particle k, or -1.
  std::int32_t east_of(std::int32_t k) const { return neighbour(east_, k); }
  std::int32_t west_of(std::int32_t k) const { return neighbour(west_, k); }
  /// The shape of the cell whose south-west corner is particle k; nullptr if there is none. Its north-west corner is
  /// k + 1, the others are east_of(k) and east_of(k) + 1.
  const CellShape<double>* shape(std::int32_t k) const {
    const std::int32_t index = shape_index_[static_cast<std::size_t>(place_in_table(k))];
    return index < 0 ? nullptr : &shapes_[static_cast<std::size_t>(index)];
  }
  /// The different shapes.
  std::span<const CellShape<double>> shapes() const { return shapes_; }

 private:
  /// Particles from `begin` on, of columns of `rows`. The table has the first two columns and the last two; those
  /// `omitted` (particles) between are as the second.
  struct Stretch {
    std::int32_t begin = 0, end = 0;
    std::int32_t begin_in_table = 0, rows = 0, omitted = 0;
  };

  std::int32_t place_in_table(std::int32_t k) const {
    if (stretches_.empty()) return k;
    std::size_t s = 0;
    while (k >= stretches_[s].end) ++s;
    const Stretch& stretch = stretches_[s];
    const std::int32_t from_begin = k - stretch.begin;
    if (from_begin < stretch.rows) return stretch.begin_in_table + from_begin;
    if (from_begin < stretch.rows + stretch.omitted)
      return stretch.begin_in_table + stretch.rows + from_begin % stretch.rows;
    return stretch.begin_in_table + from_begin - stretch.omitted;
  }
  std::int32_t neighbour(const std::vector<std::int32_t>& table, std::int32_t k) const {
    const std::int32_t here = place_in_table(k), there = table[static_cast<std::size_t>(here)];
    return there < 0 ? -1 : k + (there - here);
  }

  std::vector<Stretch> stretches_;  // none: all particles are in the table
  std::int64_t particle_count_ = 0;
  std::vector<std::int32_t> east_, west_, shape_index_;  // by place in the table
  std::vector<CellShape<double>> shapes_;
  std::int64_t cell_count_ = 0;
};

}  // namespace sphdrop
