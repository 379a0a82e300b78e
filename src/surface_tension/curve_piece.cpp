#include "surface_tension/curve_piece.hpp"

#include <cassert>

namespace sphdrop {

CurvePiece piece_of_curves(const SurfaceCurves& all, std::span<const char> is_wanted, int steps) {
  assert(is_wanted.size() == all.nodes.size() && steps >= 1);
  std::vector<char> is_taken(is_wanted.begin(), is_wanted.end());
  for (std::size_t c = 0; c < all.size(); ++c) {
    const SurfaceCurves::Range range = all.curve(c);
    for (std::size_t k = range.first; k < range.last; ++k) {
      if (!is_wanted[k]) continue;
      std::size_t before = k, after = k;
      for (int step = 0; step < steps; ++step) {
        before = range.previous(before);
        after = range.next(after);
        is_taken[before] = is_taken[after] = 1;
      }
    }
  }
  CurvePiece piece;
  piece.curves.unmatched_arcs = all.unmatched_arcs;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const SurfaceCurves::Range range = all.curve(c);
    const std::size_t first = piece.curves.nodes.size();
    for (std::size_t k = range.first; k < range.last; ++k) {
      if (!is_taken[k]) continue;
      if (!is_wanted[k]) piece.beyond.push_back(static_cast<std::int32_t>(piece.curves.nodes.size()));
      piece.number.push_back(static_cast<std::int32_t>(k));
      piece.curves.nodes.push_back(all.nodes[k]);
    }
    if (piece.curves.nodes.size() == first) continue;
    piece.curve.push_back(static_cast<std::int32_t>(c));
    piece.curves.curve_start.push_back(static_cast<std::int32_t>(piece.curves.nodes.size()));
  }
  return piece;
}

}  // namespace sphdrop
