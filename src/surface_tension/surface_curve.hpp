#pragma once
// The liquid's boundary as closed curves through the boundary particles (Sec 2.5).

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"
#include "surface_tension/boundary_detection.hpp"

namespace sphdrop {

/// Closed curves with the liquid on their left: outer ones run counterclockwise, holes clockwise. A node is an arc, so
/// a particle occurs as often as it has arcs (a chain of single particles is run along on both sides). Curves with
/// fewer than three nodes are kept but carry no force.
struct SurfaceCurves {
  struct Node {
    std::int64_t particle;  ///< global id
    Vector arc_direction;   ///< unit vector to the middle of the arc: the outward normal where a curve turns back
    Vector centre{};        ///< where the particle was, m
  };
  /// The nodes first to last - 1 of a curve, as indices into `nodes`; after the last comes the first again.
  struct Range {
    std::size_t first, last;
    std::size_t size() const { return last - first; }
    std::size_t next(std::size_t node) const { return node + 1 == last ? first : node + 1; }
    std::size_t previous(std::size_t node) const { return node == first ? last - 1 : node - 1; }
    bool carries_force() const { return size() >= 3; }
  };

  std::vector<Node> nodes;  ///< curve after curve
  std::vector<std::int32_t> curve_start = {
      0};                           ///< first node of each curve, and the number of nodes: size() + 1 entries
  std::int32_t unmatched_arcs = 0;  ///< arcs at whose end no arc began: 0 unless the particles given were incomplete

  std::size_t size() const { return curve_start.size() - 1; }
  Range curve(std::size_t index) const {
    return {static_cast<std::size_t>(curve_start[index]), static_cast<std::size_t>(curve_start[index + 1])};
  }
};

/// Joins the arcs of all particles, in any order, to curves. centres: position of each arc's particle, m; radius: 2h,
/// m. The result does not depend on the order of the arcs: a curve starts at its lowest node by (particle, previous),
/// and curves are in the order of their first nodes. Where the chain is broken, each loose end is joined to the nearest
/// loose start, so that curves are always closed; it counts in `unmatched_arcs` unless the two coincide.
SurfaceCurves connect_arcs(std::span<const Arc> arcs, std::span<const Vector> centres, double radius);

}  // namespace sphdrop
