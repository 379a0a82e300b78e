#include "surface_tension/surface_force.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include "surface_tension/local_polynomial.hpp"
#include "surface_tension/node_lanes.hpp"

namespace sphdrop {

namespace {

template <class Real>
Real length_of(const Components<Real>& segment) {
  using std::sqrt;
  return sqrt(segment.x * segment.x + segment.y * segment.y);
}

/// Unit vector from a to b; zero where they coincide, so that the sum round a curve still vanishes.
Vector tangent(Vector a, Vector b) {
  const Vector segment = b - a;
  const double length = length_of(components(segment));
  return length > 0.0 ? segment / length : Vector{};
}

/// The curve at a surface point: what it is bent by, and how much of it belongs to the point.
struct Bend {
  double curvature;      ///< kappa, positive where convex, 1/m
  Vector normal_change;  ///< kappa n dS, n inwards
};

/// A surface point's neighbours in the frame of the local tangent: x along the curve, y into the liquid.
struct LocalFrame {
  Vector origin, along;
  Vector operator()(Vector point) const {
    const Vector separation = point - origin;
    return {dot(separation, along), cross(along, separation)};
  }
};

/// Whether the abscissa advances from a to b. A steeper polynomial would only follow the particles' noise.
bool advances(Vector a, Vector b) {
  return b.x - a.x > 1e-2 * std::abs(b.y - a.y);
}

Bend bend_of_polynomial(const PolynomialDerivatives& polynomial, Vector along, double arc_length) {
  const double stretch = 1.0 + polynomial.first * polynomial.first;
  const double curvature = polynomial.second / (stretch * std::sqrt(stretch));                 // (29)
  const Vector normal = (left_normal(along) - polynomial.first * along) / std::sqrt(stretch);  // (30)
  return {curvature, curvature * arc_length * normal};
}

Bend bend_of_tangents(Vector before, Vector point, Vector after, double arc_length) {
  const Vector incoming = tangent(before, point);
  const Vector outgoing = tangent(point, after);
  const Vector change = outgoing - incoming;
  if (arc_length <= 0.0) return {0.0, change};
  return {std::copysign(length(change), cross(incoming, outgoing)) / arc_length, change};
}

Bend bend(const SurfaceCurves::Range& curve, std::span<const Vector> points, std::size_t k, int polynomial_points) {
  const Vector point = points[k];
  const std::size_t k_before = curve.previous(k);
  const std::size_t k_after = curve.next(k);
  const Vector before = points[k_before];
  const Vector after = points[k_after];
  const double arc_length = 0.5 * (length(point - before) + length(after - point));

  const LocalFrame frame{point, tangent(before, after)};
  const Vector origin{};
  const Vector m1 = frame(before);
  const Vector p1 = frame(after);
  if (!advances(m1, origin) || !advances(origin, p1)) return bend_of_tangents(before, point, after, arc_length);
  if (polynomial_points == 5 && curve.size() >= 5) {
    const Vector m2 = frame(points[curve.previous(k_before)]);
    const Vector p2 = frame(points[curve.next(k_after)]);
    if (advances(m2, m1) && advances(p1, p2))
      return bend_of_polynomial(
          derivatives_at_origin(std::array{m2.x, m1.x, p1.x, p2.x}, std::array{m2.y, m1.y, p1.y, p2.y}), frame.along,
          arc_length);
  }
  return bend_of_polynomial(derivatives_at_origin(std::array{m1.x, p1.x}, std::array{m1.y, p1.y}), frame.along,
                            arc_length);
}

void check_polynomial_points(int polynomial_points) {
  if (polynomial_points != 3 && polynomial_points != 5)
    throw std::invalid_argument("the polynomial of the surface curve goes through 3 or 5 points, not " +
                                std::to_string(polynomial_points));
}

}  // namespace

[[gnu::flatten]] void conservative_forces(const SurfaceCurves& curves, std::span<const Vector> points, double sigma,
                                          std::span<Vector> forces) {
  assert(points.size() == curves.nodes.size() && forces.size() == points.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    // First the tangents that go out of the points.
    const auto one = [&](std::size_t k) { forces[k] = tangent(points[k], points[curve.next(k)]); };
    const auto many = [&](std::size_t k) {
      const Components<Pack> segment = load_lanes(points, k + 1) - load_lanes(points, k);
      const Pack length = length_of(segment);
      if (!(hmin(length) > 0.0)) return false;
      store_lanes({segment.x / length, segment.y / length}, forces, k);
      return true;
    };
    for_each_node(curve, many, one);
    const Vector before_first = forces[curve.last - 1];
    for (std::size_t k = curve.last - 1; k > curve.first; --k) forces[k] = sigma * (forces[k] - forces[k - 1]);
    forces[curve.first] = sigma * (forces[curve.first] - before_first);
    if (!curve.carries_force()) std::fill(&forces[curve.first], &forces[curve.first] + curve.size(), Vector{});
  }
}

void curvature_forces(const SurfaceCurves& curves, std::span<const Vector> points, double sigma, int polynomial_points,
                      std::span<Vector> forces) {
  check_polynomial_points(polynomial_points);
  assert(points.size() == curves.nodes.size() && forces.size() == points.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last; ++k)
      forces[k] = curve.carries_force() ? sigma * bend(curve, points, k, polynomial_points).normal_change  // (31)
                                        : Vector{};
  }
}

void add_pressure_forces(const SurfaceCurves& curves, std::span<const Vector> points, double pressure,
                         std::span<Vector> forces) {
  assert(points.size() == curves.nodes.size() && forces.size() == points.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    if (!curve.carries_force()) continue;
    for (std::size_t k = curve.first; k < curve.last; ++k)
      forces[k] += 0.5 * pressure * right_normal(points[curve.next(k)] - points[curve.previous(k)]);
  }
}

void curvatures(const SurfaceCurves& curves, std::span<const Vector> points, int polynomial_points,
                std::span<double> curvature) {
  check_polynomial_points(polynomial_points);
  assert(points.size() == curves.nodes.size() && curvature.size() == points.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last; ++k)
      curvature[k] = curve.carries_force() ? bend(curve, points, k, polynomial_points).curvature : 0.0;
  }
}

}  // namespace sphdrop
