#pragma once
// Who stands nearest to whom, of any cloud of points: strays, clumps and lines cost no more than others.

#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

struct NearestNeighbours {
  std::vector<std::int32_t> index;  ///< of the nearest other point; -1 of a point that is alone
  std::vector<double> distance;     ///< to it; infinite then
};

/// Shapes: [points]. By a k-d tree (Bentley 1975), n log n.
NearestNeighbours nearest_neighbours(std::span<const Vector> points);

/// The median of all distances; of an even number the upper one.
double median_distance(const NearestNeighbours& neighbours);

}  // namespace sphdrop
