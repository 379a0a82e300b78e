#pragma once
// Square cells of the plane and a table that numbers the occupied ones.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sphdrop {

/// The cell that covers [column, column + 1) x [row, row + 1) in units of the cell size.
struct Cell {
  std::int32_t column = 0, row = 0;
  friend constexpr bool operator==(Cell, Cell) = default;
  friend constexpr bool operator<(Cell a, Cell b) { return a.column != b.column ? a.column < b.column : a.row < b.row; }
};

/// Cells further than this from the origin are refused: offsets between any two still fit 32 bits.
constexpr double largest_cell_coordinate = 1 << 29;

/// Whether a point (in units of the cell size) lies in a cell at all: finite and not absurdly far away.
bool is_in_a_cell(double u, double v);
/// The cell of a point in units of the cell size, which must be in one (asserted).
Cell cell_at(double u, double v);

/// Cells numbered 0, 1, 2, ... in the order in which they were inserted: a hash table with open addressing, because
/// cells are looked up for every point and a box around all of them may be large and empty.
class CellIndex {
 public:
  static constexpr std::int32_t absent = -1;

  void clear();
  /// The number of `cell`, or `absent`.
  std::int32_t find(Cell cell) const;
  /// The number of `cell`, which is added if it is new.
  std::int32_t insert(Cell cell);

  std::span<const Cell> cells() const { return cells_; }
  std::size_t size() const { return cells_.size(); }

 private:
  std::size_t slot_of(Cell cell) const;
  void grow();

  std::vector<Cell> cells_;
  std::vector<std::int32_t> slots_;  ///< a power of two of them, at most half full
};

}  // namespace sphdrop
