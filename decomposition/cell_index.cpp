#include "decomposition/cell_index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sphdrop {
namespace {

constexpr std::size_t smallest_slot_count = 64;

std::uint64_t hash(Cell cell) {
  std::uint64_t h =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.column)) << 32 | static_cast<std::uint32_t>(cell.row);
  h *= 0x9e3779b97f4a7c15U;
  h ^= h >> 32;
  h *= 0xbf58476d1ce4e5b9U;
  return h ^ h >> 29;
}

}  // namespace

bool is_in_a_cell(double u, double v) {
  // Written so that a NaN fails.
  return std::abs(u) < largest_cell_coordinate && std::abs(v) < largest_cell_coordinate;
}

Cell cell_at(double u, double v) {
  assert(is_in_a_cell(u, v));
  return {static_cast<std::int32_t>(std::floor(u)), static_cast<std::int32_t>(std::floor(v))};
}

void CellIndex::clear() {
  cells_.clear();
  std::fill(slots_.begin(), slots_.end(), absent);
}

std::size_t CellIndex::slot_of(Cell cell) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(cell) & mask;
  while (slots_[slot] != absent && cells_[static_cast<std::size_t>(slots_[slot])] != cell) slot = (slot + 1) & mask;
  return slot;
}

std::int32_t CellIndex::find(Cell cell) const {
  return slots_.empty() ? absent : slots_[slot_of(cell)];
}

std::int32_t CellIndex::insert(Cell cell) {
  if (2 * (cells_.size() + 1) > slots_.size()) grow();
  std::int32_t& number = slots_[slot_of(cell)];
  if (number == absent) {
    number = static_cast<std::int32_t>(cells_.size());
    cells_.push_back(cell);
  }
  return number;
}

void CellIndex::grow() {
  slots_.assign(std::max(smallest_slot_count, 2 * slots_.size()), absent);
  for (std::size_t k = 0; k < cells_.size(); ++k) slots_[slot_of(cells_[k])] = static_cast<std::int32_t>(k);
}

}  // namespace sphdrop
