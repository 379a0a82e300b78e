#pragma once

#include <cstdint>
#include <vector>

namespace sphdrop {

/// Consecutive columns of a square lattice that are alike; a body is described by its stretches from left to right.
struct ColumnStretch {
  std::int64_t columns = 0;
  std::int64_t lowest_row = 0;  ///< counted alike for all stretches of a body
  std::vector<char> is_held;    ///< of a column's particles from bottom to top: 1 for those that never move

  std::int64_t rows() const { return static_cast<std::int64_t>(is_held.size()); }
  std::int64_t particles() const { return columns * rows(); }
  bool operator==(const ColumnStretch&) const = default;
};

}  // namespace sphdrop
