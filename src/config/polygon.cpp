#include "config/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sphdrop {
namespace {

double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether c, which is on the line through a and b, lies between them.
bool is_between(const Point& a, const Point& b, const Point& c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

bool have_common_point(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double first = turn(a, b, c), second = turn(a, b, d), third = turn(c, d, a), fourth = turn(c, d, b);
  if (((first > 0 && second < 0) || (first < 0 && second > 0)) &&
      ((third > 0 && fourth < 0) || (third < 0 && fourth > 0)))
    return true;
  return (first == 0 && is_between(a, b, c)) || (second == 0 && is_between(a, b, d)) ||
         (third == 0 && is_between(c, d, a)) || (fourth == 0 && is_between(c, d, b));
}

}  // namespace

Extent extent_of(const Points& points) {
  if (points.empty()) return {};
  Extent extent{points[0], points[0]};
  for (const Point& p : points) {
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
  }
  return extent;
}

double area_of(const Points& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += turn(polygon[0], polygon[k], polygon[(k + 1) % polygon.size()]);
  return 0.5 * std::abs(twice);
}

double perimeter_of(const Points& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    sum += std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  return sum;
}

std::optional<std::string> polygon_mistake(const Points& polygon) {
  const std::size_t n = polygon.size();
  if (n < 3) return fmt::format("has {} corner{}; a polygon has at least 3", n, n == 1 ? "" : "s");
  const auto corner = [&](std::size_t k) { return polygon[k % n]; };
  for (std::size_t k = 0; k < n; ++k)
    if (corner(k) == corner(k + 1))
      return fmt::format("gives the corner ({}, {}) m twice in a row, as corners {} and {}; leave one of them out",
                         corner(k).x, corner(k).y, k + 1, (k + 1) % n + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const Point a = corner(k), b = corner(k + 1), c = corner(k + 2);
    const double along = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
    if (turn(a, b, c) == 0 && along < 0)
      return fmt::format("turns back on itself at corner {}, ({}, {}) m", (k + 1) % n + 1, b.x, b.y);
  }
  for (std::size_t j = 0; j + 2 < n; ++j)
    for (std::size_t k = j + 2; k < n; ++k) {
      if (j == 0 && k == n - 1) continue;  // they share a corner
      if (have_common_point(corner(j), corner(j + 1), corner(k), corner(k + 1)))
        return fmt::format(
            "crosses or touches itself: its side from corner {} to {}, at ({}, {}) m, meets that from corner {} to {}, "
            "at ({}, {}) m; give the corners in the order in which the outline passes them",
            j + 1, j + 2, corner(j).x, corner(j).y, k + 1, (k + 1) % n + 1, corner(k).x, corner(k).y);
    }
  return std::nullopt;
}

}  // namespace sphdrop
