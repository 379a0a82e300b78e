#pragma once
// Vectors of the plane.

#include <cmath>

namespace sphdrop {

struct Vector {
  double x = 0, y = 0;

  friend constexpr Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vector operator-(Vector a) { return {-a.x, -a.y}; }
  friend constexpr Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
  friend constexpr Vector operator*(Vector a, double s) { return s * a; }
  friend constexpr Vector operator/(Vector a, double s) { return {a.x / s, a.y / s}; }
  constexpr Vector& operator+=(Vector b) { return *this = *this + b; }
  constexpr Vector& operator-=(Vector b) { return *this = *this - b; }
  friend constexpr bool operator==(Vector a, Vector b) = default;
};

constexpr double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
/// The out-of-plane component of a x b: positive where b lies to the left of a.
constexpr double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
constexpr double squared_length(Vector a) {
  return dot(a, a);
}
/// sqrt is correctly rounded everywhere, hypot is not: this one gives the same bits on every machine.
inline double length(Vector a) {
  return std::sqrt(squared_length(a));
}
/// a / |a|; a must not be zero.
inline Vector unit(Vector a) {
  return a / length(a);
}
/// a turned by a right angle to the left.
constexpr Vector left_normal(Vector a) {
  return {-a.y, a.x};
}
/// a turned by a right angle to the right: the outward normal of a curve that has the liquid on its left.
constexpr Vector right_normal(Vector a) {
  return {a.y, -a.x};
}

/// a less its component along b; a itself where b is zero.
constexpr Vector without_component(Vector a, Vector b) {
  const double squared = squared_length(b);
  return squared > 0.0 ? a - (dot(a, b) / squared) * b : a;
}

}  // namespace sphdrop
