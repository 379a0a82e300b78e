#pragma once
// The part of the curves that one rank works on.

#include <cstdint>
#include <span>
#include <vector>

#include "surface_tension/surface_curve.hpp"

namespace sphdrop {

/// Of each curve the nodes that are wanted, those a few steps along the curve from them, and nothing in between: the
/// others have been left out, and the rest closed up in the order it had. What is worked out of a node's near
/// neighbours on the curve is right at the wanted nodes, and is to be left alone `beyond`.
struct CurvePiece {
  SurfaceCurves curves;
  std::vector<std::int32_t> number;  ///< of each node, among all
  std::vector<Vector> first_places;  ///< by curve: where the whole one's first particle was, m
  std::vector<std::int32_t> beyond;  ///< nodes that are there for their neighbours' sake
};

/// is_wanted: by node. `steps`: how far along the curve what is worked out looks. A curve of fewer than three nodes is
/// taken whole or not at all, so that a curve of the piece carries a force where the whole one does; with two steps or
/// more it also has five nodes where the whole one has as many.
CurvePiece piece_of_curves(SurfaceCurves all, std::span<const char> is_wanted, int steps);

}  // namespace sphdrop
