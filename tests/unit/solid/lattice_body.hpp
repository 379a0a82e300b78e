#pragma once
// Bodies on a lattice drawn as text: "#" a free particle, "H" a held one, "." nothing; the first line is the top.

#include <string>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop::test {

struct LatticeBody {
  std::vector<Vector> positions;  ///< column by column, from bottom to top in a column
  std::vector<char> is_held;
};

inline LatticeBody lattice_body(const std::vector<std::string>& drawing, double d) {
  LatticeBody body;
  for (std::size_t column = 0; column < drawing[0].size(); ++column)
    for (std::size_t row = 0; row < drawing.size(); ++row) {
      const char mark = drawing[drawing.size() - 1 - row][column];
      if (mark == '.') continue;
      body.positions.push_back(d * Vector{static_cast<double>(column), static_cast<double>(row)});
      body.is_held.push_back(mark == 'H' ? 1 : 0);
    }
  return body;
}

/// With convex and re-entrant corners, a hole, a neck one cell wide and cells that meet in a point.
inline const std::vector<std::string> notched{
    "####...####", "####...####", "###########", "###########", "###..####..",
    "#########..", "#########..", "####.....##", "####.....##",
};
inline constexpr int notched_count = 8 + 8 + 11 + 11 + 7 + 9 + 9 + 6 + 6;

}  // namespace sphdrop::test
