#include "setup/polygon_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sphdrop {
namespace {

/// The part of the polygon on the side of the line where side(corner) >= 0.
template <class Side>
void clip(std::span<const Vector> polygon, const Side& side, std::vector<Vector>& part) {
  part.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double of_a = side(a), of_b = side(b);
    if (of_a >= 0.0) part.push_back(a);
    if ((of_a > 0.0 && of_b < 0.0) || (of_a < 0.0 && of_b > 0.0)) part.push_back(a + of_a / (of_a - of_b) * (b - a));
  }
}

struct Line {
  Vector place, direction;
};

// Where they meet; not finite where they are parallel.
Vector crossing(const Line& a, const Line& b) {
  const double along = cross(b.place - a.place, b.direction) / cross(a.direction, b.direction);
  return a.place + along * a.direction;
}

}  // namespace

std::vector<Vector> counterclockwise_polygon(const Points& corners, double unit) {
  std::vector<Vector> polygon;
  for (const Point& p : corners) polygon.push_back({p.x / unit, p.y / unit});
  if (signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

double signed_area(std::span<const Vector> polygon) {
  double twice = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += cross(polygon[k] - polygon[0], polygon[k + 1 < polygon.size() ? k + 1 : 0] - polygon[0]);
  return 0.5 * twice;
}

bool contains(std::span<const Vector> polygon, Vector place) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    if ((a.y > place.y) == (b.y > place.y)) continue;
    if (place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

void clip_in_x(std::span<const Vector> polygon, double low, double high, std::vector<Vector>& part) {
  std::vector<Vector> half;
  clip(
      polygon, [&](Vector p) { return p.x - low; }, half);
  clip(
      half, [&](Vector p) { return high - p.x; }, part);
}

void clip_in_y(std::span<const Vector> polygon, double low, double high, std::vector<Vector>& part) {
  std::vector<Vector> half;
  clip(
      polygon, [&](Vector p) { return p.y - low; }, half);
  clip(
      half, [&](Vector p) { return high - p.y; }, part);
}

PlaneMoments moments_of(std::span<const Vector> polygon, Vector place) {
  PlaneMoments m;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector a = polygon[k] - place, b = polygon[k + 1 < polygon.size() ? k + 1 : 0] - place;
    const double c = cross(a, b);
    m.area += c / 2.0;
    m.first_x += c * (a.x + b.x) / 6.0;
    m.first_y += c * (a.y + b.y) / 6.0;
    m.second_x += c * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
    m.second_y += c * (a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
  }
  return m;
}

double distance_to_border(std::span<const Vector> polygon, Vector place) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector a = polygon[k], side = polygon[k + 1 < polygon.size() ? k + 1 : 0] - a;
    const double along = std::clamp(dot(place - a, side) / squared_length(side), 0.0, 1.0);
    smallest = std::min(smallest, squared_length(place - (a + along * side)));
  }
  return std::sqrt(smallest);
}

std::vector<Vector> inset_polygon(std::span<const Vector> polygon, double distance) {
  std::vector<Line> sides;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector a = polygon[k], b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const Vector direction = unit(b - a);
    // Of two sides in one line the second adds nothing, and their crossing would not be defined.
    if (!sides.empty() && std::abs(cross(sides.back().direction, direction)) < 1e-9 &&
        dot(sides.back().direction, direction) > 0.0)
      continue;
    sides.push_back({a + distance * left_normal(direction), direction});
  }
  if (sides.size() > 2 && std::abs(cross(sides.back().direction, sides.front().direction)) < 1e-9 &&
      dot(sides.back().direction, sides.front().direction) > 0.0)
    sides.erase(sides.begin());
  std::vector<Vector> corners;
  while (sides.size() >= 3) {
    // Corner k is the one between the side before and side k.
    corners.clear();
    for (std::size_t k = 0; k < sides.size(); ++k)
      corners.push_back(crossing(sides[k == 0 ? sides.size() - 1 : k - 1], sides[k]));
    std::size_t worst = 0;
    double most_reversed = 0.0;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const double along = dot(corners[k + 1 < sides.size() ? k + 1 : 0] - corners[k], sides[k].direction);
      if (!std::isfinite(along)) return {};
      if (along < most_reversed) {
        most_reversed = along;
        worst = k;
      }
    }
    if (most_reversed >= 0.0) return signed_area(corners) > 0.0 ? corners : std::vector<Vector>{};
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return {};
}

std::vector<Vector> subdivided(std::span<const Vector> polygon, double spacing) {
  std::vector<Vector> places;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector a = polygon[k], side = polygon[k + 1 < polygon.size() ? k + 1 : 0] - a;
    // Rounding must not make one piece more of a side that is a whole number of spacings long.
    const int pieces = std::max(1, static_cast<int>(std::ceil(length(side) / spacing * (1.0 - 1e-9))));
    for (int piece = 0; piece < pieces; ++piece) places.push_back(a + (static_cast<double>(piece) / pieces) * side);
  }
  return places;
}

}  // namespace sphdrop
