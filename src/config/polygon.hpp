#pragma once
// Polygons as a case gives them.

#include <optional>
#include <string>

#include "config/case.hpp"

namespace sphdrop {

struct Extent {
  Point low, high;
};

/// The box about the points; all zero where there are none.
Extent extent_of(const Points& points);

/// Without sign, m2.
double area_of(const Points& polygon);

/// Of the closed line, m.
double perimeter_of(const Points& polygon);

/// What keeps the points from being the corners of a polygon, that its border touches or crosses itself, or nothing.
std::optional<std::string> polygon_mistake(const Points& polygon);

}  // namespace sphdrop
