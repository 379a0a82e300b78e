#pragma once

#include <algorithm>
#include <limits>

#include "particles/vector.hpp"

namespace sphdrop {

/// A rectangle along the axes, m; empty at first.
struct Box {
  Vector low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vector high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void include(Vector p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void include(const Box& other) {
    low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
    high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
  }
  bool contains(Vector p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
  bool contains(const Box& other) const { return contains(other.low) && contains(other.high); }
  bool meets(const Box& other) const {
    return other.low.x <= high.x && other.high.x >= low.x && other.low.y <= high.y && other.high.y >= low.y;
  }
  Box grown_by(double margin) const { return {low - Vector{margin, margin}, high + Vector{margin, margin}}; }
  Box moved_by(Vector shift) const { return {low + shift, high + shift}; }
};

}  // namespace sphdrop
