#pragma once
// The particles along the liquid's surface.

#include <cstdint>
#include <span>
#include <vector>

#include "particles/vector.hpp"

namespace sphdrop {

/// The indices of the particles at (x, y) that are within `reach` of any of `points`, ascending; all in m. Quick where
/// particles that follow one another are near each other.
std::vector<std::int32_t> particles_near(std::span<const Vector> points, std::span<const double> x,
                                         std::span<const double> y, double reach);

}  // namespace sphdrop
