#include "surface_tension/curve_piece.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace sphdrop {

CurvePiece piece_of_curves(SurfaceCurves all, std::span<const char> is_wanted, int steps) {
  assert(is_wanted.size() == all.nodes.size() && steps >= 1);
  CurvePiece piece;
  if (std::find(is_wanted.begin(), is_wanted.end(), 0) == is_wanted.end()) {
    for (std::size_t c = 0; c < all.size(); ++c) piece.first_places.push_back(all.nodes[all.curve(c).first].centre);
    piece.number.resize(all.nodes.size());
    std::iota(piece.number.begin(), piece.number.end(), 0);
    piece.curves = std::move(all);
    return piece;
  }
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
    piece.first_places.push_back(all.nodes[range.first].centre);
    piece.curves.curve_start.push_back(static_cast<std::int32_t>(piece.curves.nodes.size()));
  }
  return piece;
}

}  // namespace sphdrop
