#pragma once
// Polygons as lists of corners. Only + - * / and sqrt: the same bits on every machine.

#include <span>
#include <vector>

#include "config/case.hpp"
#include "particles/plane_moments.hpp"
#include "particles/vector.hpp"

namespace sphdrop {

/// Counterclockwise, divided by `unit` (m).
std::vector<Vector> counterclockwise_polygon(const Points& corners, double unit);

/// Positive counterclockwise.
double signed_area(std::span<const Vector> polygon);

/// Whether the place lies within the polygon; on its border either may be said.
bool contains(std::span<const Vector> polygon, Vector place);

/// The part of the polygon with low <= x <= high, and likewise with y (Sutherland & Hodgman). Of a polygon that is not
/// convex the part's border may run along the cut forth and back, which no integral over the part notices.
void clip_in_x(std::span<const Vector> polygon, double low, double high, std::vector<Vector>& part);
void clip_in_y(std::span<const Vector> polygon, double low, double high, std::vector<Vector>& part);

/// Of the inside of a counterclockwise polygon, about `place`, by Green's theorem.
PlaneMoments moments_of(std::span<const Vector> polygon, Vector place);

/// m, or the polygon's unit.
double distance_to_border(std::span<const Vector> polygon, Vector place);

/// The sides of a counterclockwise polygon moved inwards by `distance` and cut where they meet; sides that vanish are
/// left out. Empty where nothing is left.
std::vector<Vector> inset_polygon(std::span<const Vector> polygon, double distance);

/// Its corners and, between them, places at most `spacing` apart: the same line.
std::vector<Vector> subdivided(std::span<const Vector> polygon, double spacing);

}  // namespace sphdrop
