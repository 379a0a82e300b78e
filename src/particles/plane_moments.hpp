#pragma once
// Area of a part of the plane and how it lies.

namespace sphdrop {

/// About a place that the context names: the integrals of 1, x, y, x^2 and y^2 over the part. Units: those of the
/// context to the power of 2, 3 and 4.
struct PlaneMoments {
  double area = 0, first_x = 0, first_y = 0, second_x = 0, second_y = 0;

  PlaneMoments& operator+=(const PlaneMoments& other) {
    area += other.area;
    first_x += other.first_x;
    first_y += other.first_y;
    second_x += other.second_x;
    second_y += other.second_y;
    return *this;
  }
  friend bool operator==(const PlaneMoments&, const PlaneMoments&) = default;
};

/// About a place that lies at (x, y) from the old one.
constexpr PlaneMoments moments_about(const PlaneMoments& m, double x, double y) {
  return {m.area, m.first_x - m.area * x, m.first_y - m.area * y, m.second_x - 2.0 * x * m.first_x + x * x * m.area,
          m.second_y - 2.0 * y * m.first_y + y * y * m.area};
}

}  // namespace sphdrop
