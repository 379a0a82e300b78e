#include "surface_tension/surface_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "drops.hpp"
#include "surface_tension/local_polynomial.hpp"
#include "surface_tension/surface_points.hpp"

namespace sphdrop {
namespace {

using namespace test;

/// Of all curves that carry a force.
double total_length(const SurfaceCurves& curves, const Positions& points) {
  double sum = 0.0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last && curve.carries_force(); ++k)
      sum += length(points[curve.next(k)] - points[k]);
  }
  return sum;
}

double total_area(const SurfaceCurves& curves, const Positions& points) {
  double sum = 0.0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const SurfaceCurves::Range curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last && curve.carries_force(); ++k)
      sum += 0.5 * cross(points[k], points[curve.next(k)]);
  }
  return sum;
}

constexpr double sigma = 0.072;

struct Drop {
  SurfaceCurves curves;
  Positions points;
};

Drop jittered_drop(unsigned seed) {
  Positions positions = lattice(12, 0.5, [](double x, double y) {
    const double squared = x * x + y * y;
    return squared < 110 && squared > 20;
  });
  jitter(positions, 0.2 * spacing, seed);
  Drop drop{curves_of(positions), {}};
  drop.points.resize(drop.curves.nodes.size());
  surface_points(drop.curves, node_positions(drop.curves, positions), spacing, drop.points);
  return drop;
}

/// 40 points of different spacing on an ellipse.
Positions uneven_ellipse(double a, double b, int count) {
  Positions points;
  for (int k = 0; k < count; ++k) {
    const double u = 2.0 * std::numbers::pi * k / count;
    const double parameter = u + 0.3 * std::sin(3.0 * u) / 3.0;
    points.push_back({a * std::cos(parameter), b * std::sin(parameter)});
  }
  return points;
}

double ellipse_curvature(double a, double b, Vector point) {
  const Vector scaled = {point.x * b / a, point.y * a / b};  // (b cos, a sin)
  const double metric = scaled.y * scaled.y + scaled.x * scaled.x;
  return a * b / (metric * std::sqrt(metric));
}

double largest_curvature_error(double a, double b, const Positions& points, int polynomial_points) {
  const SurfaceCurves curves = plain_curves({static_cast<int>(points.size())});
  std::vector<double> curvature(points.size());
  curvatures(curves, points, polynomial_points, curvature);
  double error = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double exact = ellipse_curvature(a, b, points[k]);
    error = std::max(error, std::abs(curvature[k] / exact - 1.0));
  }
  return error;
}

TEST(LocalPolynomial, DifferentiatesPolynomialsExactly) {
  const auto parabola = [](double x) { return 0.7 * x - 1.3 * x * x; };
  const auto three = derivatives_at_origin(std::array{-1.1, 0.8}, std::array{parabola(-1.1), parabola(0.8)});
  EXPECT_NEAR(three.first, 0.7, 1e-14);
  EXPECT_NEAR(three.second, -2.6, 1e-14);

  const auto quartic = [](double x) { return 0.7 * x - 1.3 * x * x + 0.4 * x * x * x - 0.9 * x * x * x * x; };
  const std::array x{-2.3, -1.1, 0.8, 1.7};
  const auto five = derivatives_at_origin(x, std::array{quartic(x[0]), quartic(x[1]), quartic(x[2]), quartic(x[3])});
  EXPECT_NEAR(five.first, 0.7, 1e-13);
  EXPECT_NEAR(five.second, -2.6, 1e-13);
}

TEST(Curvature, OfACircleIsOneOverItsRadius) {
  const double radius = 5e-4;
  const Positions points = ellipse(radius, radius, 126);
  EXPECT_LT(largest_curvature_error(radius, radius, points, 3), 2e-3);
  EXPECT_LT(largest_curvature_error(radius, radius, points, 5), 2e-5);
}

TEST(Curvature, OfAnEllipseConvergesAndFivePointsDoSoFaster) {
  const double a = 8e-4;
  const double b = 4e-4;
  for (const auto& outline : {ellipse, uneven_ellipse}) {
    const double coarse_3 = largest_curvature_error(a, b, outline(a, b, 100), 3);
    const double fine_3 = largest_curvature_error(a, b, outline(a, b, 200), 3);
    const double coarse_5 = largest_curvature_error(a, b, outline(a, b, 100), 5);
    const double fine_5 = largest_curvature_error(a, b, outline(a, b, 200), 5);
    EXPECT_LT(coarse_3, 0.1);
    EXPECT_LT(coarse_5, 0.2 * coarse_3);
    EXPECT_LT(fine_3, 0.55 * coarse_3);  // first order at least, second where the points are evenly spaced
    EXPECT_LT(fine_5, 0.15 * coarse_5);  // third order at least
  }
}

TEST(Curvature, OfThreePointsIsThatOfTheParabolaThroughThem) {
  // Seen along the chord of its neighbours, the first point has P' = -2/3 and P'' = 2/3.
  const SurfaceCurves curves = plain_curves({3});
  const Positions points = {{0.0, 0.0}, {3.0, 1.0}, {-1.0, 1.0}};
  std::vector<double> curvature(3);
  Positions forces(3);
  curvatures(curves, points, 3, curvature);
  curvature_forces(curves, points, sigma, 3, forces);
  const double stretch = std::sqrt(1.0 + 4.0 / 9.0);
  EXPECT_NEAR(curvature[0], 2.0 / 3.0 / (stretch * stretch * stretch), 1e-14);
  const Vector normal = Vector{2.0 / 3.0, 1.0} / stretch;
  const double arc_length = 0.5 * (std::sqrt(10.0) + std::sqrt(2.0));
  EXPECT_LT(length(forces[0] - sigma * curvature[0] * arc_length * normal), 1e-15);
}

TEST(Curvature, IsNegativeOnABubble) {
  const double radius = 5e-4;
  Positions points = ellipse(radius, radius, 126);
  std::reverse(points.begin(), points.end());
  std::vector<double> curvature(points.size());
  curvatures(plain_curves({126}), points, 3, curvature);
  for (const double kappa : curvature) EXPECT_NEAR(kappa * radius, -1.0, 2e-3);
}

TEST(Curvature, DoesNotDependOnTheDirectionInSpace) {
  const double a = 8e-4;
  const double b = 4e-4;
  const Positions points = uneven_ellipse(a, b, 60);
  Positions turned;
  for (const Vector p : points) turned.push_back({0.6 * p.x - 0.8 * p.y + 1e-3, 0.8 * p.x + 0.6 * p.y});
  const SurfaceCurves curves = plain_curves({60});
  for (const int polynomial_points : {3, 5}) {
    std::vector<double> curvature(60), curvature_turned(60);
    curvatures(curves, points, polynomial_points, curvature);
    curvatures(curves, turned, polynomial_points, curvature_turned);
    for (std::size_t k = 0; k < 60; ++k) EXPECT_NEAR(curvature_turned[k], curvature[k], 1e-9 * std::abs(curvature[k]));
  }
}

TEST(CurvatureForce, IsSigmaKappaTimesTheInwardNormal) {
  const double a = 8e-4;
  const double b = 4e-4;
  const Positions points = ellipse(a, b, 400);
  const SurfaceCurves curves = plain_curves({400});
  for (const int polynomial_points : {3, 5}) {
    Positions forces(400);
    curvature_forces(curves, points, sigma, polynomial_points, forces);
    for (std::size_t k = 0; k < 400; ++k) {
      const Vector inward = -unit(Vector{points[k].x / (a * a), points[k].y / (b * b)});
      const double arc =
          0.5 * (length(points[(k + 1) % 400] - points[k]) + length(points[k] - points[(k + 399) % 400]));
      const Vector expected = sigma * ellipse_curvature(a, b, points[k]) * arc * inward;
      EXPECT_LT(length(forces[k] - expected), 2e-3 * length(expected)) << k;
    }
  }
}

TEST(CurvatureForce, FallsBackWhereThePointsTurnBack) {
  // A spike: at its tip the curve turns by nearly half a turn; two points on, the outline doubles back.
  const SurfaceCurves curves = plain_curves({6});
  const Positions points = {{0.0, 0.0}, {1.0, -0.005}, {2.0, -0.005}, {3.0, 0.0}, {2.0, 0.005}, {1.0, 0.005}};
  Positions forces(6), expected(6), three(6);
  conservative_forces(curves, points, sigma, expected);
  curvature_forces(curves, points, sigma, 5, forces);
  curvature_forces(curves, points, sigma, 3, three);
  for (const std::size_t tip : {0U, 3U}) {
    EXPECT_EQ(forces[tip], expected[tip]);
    EXPECT_EQ(three[tip], expected[tip]);
  }
  for (const std::size_t beside : {1U, 2U, 4U, 5U}) {
    EXPECT_EQ(forces[beside], three[beside]);  // five points do not advance, three do
    EXPECT_NE(three[beside], expected[beside]);
  }
  std::vector<double> curvature(6);
  curvatures(curves, points, 5, curvature);
  EXPECT_NEAR(curvature[3], 2.0, 1e-3);  // the tangent turns by two unit vectors over one unit of length

  Positions slit(points.rbegin(), points.rend());  // the same outline round a hole: the tip is now at 2
  curvatures(curves, slit, 5, curvature);
  EXPECT_NEAR(curvature[2], -2.0, 1e-3);
}

TEST(CurvatureForce, TakesThreeOrFivePoints) {
  const SurfaceCurves curves = plain_curves({4});
  Positions points = ellipse(1.0, 1.0, 4);
  Positions forces(4);
  std::vector<double> curvature(4);
  EXPECT_THROW(curvature_forces(curves, points, sigma, 4, forces), std::invalid_argument);
  EXPECT_THROW(curvatures(curves, points, 7, curvature), std::invalid_argument);
  EXPECT_NO_THROW(curvature_forces(curves, points, sigma, 5, forces));  // fewer than five nodes: three points
}

TEST(ConservativeForce, IsMinusTheGradientOfTheLength) {
  Drop drop = jittered_drop(5);
  Positions forces(drop.points.size());
  conservative_forces(drop.curves, drop.points, sigma, forces);
  const double step = 1e-6 * spacing;
  for (std::size_t k = 0; k < drop.points.size(); ++k) {
    const auto energy = [&](Vector shift) {
      Positions shifted = drop.points;
      shifted[k] += shift;
      return sigma * total_length(drop.curves, shifted);
    };
    const double slope_x = (energy({step, 0.0}) - energy({-step, 0.0})) / (2.0 * step);
    const double slope_y = (energy({0.0, step}) - energy({0.0, -step})) / (2.0 * step);
    EXPECT_NEAR(forces[k].x, -slope_x, 1e-6 * sigma) << k;
    EXPECT_NEAR(forces[k].y, -slope_y, 1e-6 * sigma) << k;
  }
}

TEST(ConservativeForce, HasNeitherNetForceNorTorqueRoundAnyCurve) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Drop drop = jittered_drop(seed);
    ASSERT_GE(drop.curves.size(), 2U);
    Positions forces(drop.points.size());
    conservative_forces(drop.curves, drop.points, sigma, forces);
    for (std::size_t c = 0; c < drop.curves.size(); ++c) {
      const auto curve = drop.curves.curve(c);
      Vector sum;
      double torque = 0.0;
      double largest = 0.0;
      for (std::size_t k = curve.first; k < curve.last; ++k) {
        sum += forces[k];
        torque += cross(drop.points[k], forces[k]);
        largest = std::max(largest, length(forces[k]));
      }
      EXPECT_GT(largest, 0.01 * sigma);
      EXPECT_LT(length(sum), 1e-14 * sigma);
      EXPECT_LT(std::abs(torque), 1e-14 * sigma * 100 * spacing);
    }
  }
}

TEST(ConservativeForce, BalancesTheLaplacePressureOfARoundDrop) {
  const double radius = 5e-4;
  const Positions points = ellipse(radius, radius, 126);
  Positions forces(126);
  conservative_forces(plain_curves({126}), points, sigma, forces);
  const double expected = 2.0 * sigma * std::sin(std::numbers::pi / 126);
  for (std::size_t k = 0; k < 126; ++k)
    EXPECT_LT(length(forces[k] + expected * unit(points[k])), 1e-12 * expected) << k;
}

TEST(SurfaceForce, CurvesOfFewerThanThreeNodesCarryNone) {
  const SurfaceCurves curves = plain_curves({1, 2, 3});
  const Positions points = {{5, 5}, {7, 7}, {8, 7}, {0, 0}, {1, 0}, {0, 1}};
  Positions conservative(6), by_curvature(6);
  std::vector<double> curvature(6);
  conservative_forces(curves, points, sigma, conservative);
  curvature_forces(curves, points, sigma, 3, by_curvature);
  curvatures(curves, points, 3, curvature);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(conservative[k], Vector{});
    EXPECT_EQ(by_curvature[k], Vector{});
    EXPECT_EQ(curvature[k], 0.0);
  }
  for (std::size_t k = 3; k < 6; ++k) {
    EXPECT_GT(length(conservative[k]), sigma);
    EXPECT_GT(length(by_curvature[k]), 0.1 * sigma);
    EXPECT_GT(curvature[k], 0.0);
  }
}

TEST(SurfaceForce, SurvivesCoincidentPoints) {
  const SurfaceCurves curves = plain_curves({6, 3});
  const Positions points = {{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {4, 4}, {4, 4}, {4, 4}};
  Positions forces(9);
  std::vector<double> curvature(9);
  const auto check = [&] {
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_TRUE(std::isfinite(forces[k].x) && std::isfinite(forces[k].y)) << k;
      EXPECT_LE(length(forces[k]), 3.0 * sigma) << k;
      if (k >= 6) {
        EXPECT_EQ(forces[k], Vector{});
      }
    }
  };
  conservative_forces(curves, points, sigma, forces);
  check();
  Vector sum;
  for (const Vector force : forces) sum += force;
  EXPECT_LT(length(sum), 1e-15);
  for (const int polynomial_points : {3, 5}) {
    curvature_forces(curves, points, sigma, polynomial_points, forces);
    check();
    curvatures(curves, points, polynomial_points, curvature);
    for (const double kappa : curvature) EXPECT_TRUE(std::isfinite(kappa));
  }
}

TEST(PressureForce, IsThePressureTimesTheGradientOfTheArea) {
  Drop drop = jittered_drop(11);
  const double pressure = 144.0;
  std::vector<Vector> forces(drop.points.size(), Vector{1.0, 2.0});  // is added to
  add_pressure_forces(drop.curves, drop.points, pressure, forces);
  const double step = 1e-3 * spacing;
  for (std::size_t k = 0; k < drop.points.size(); k += 7) {
    for (const Vector direction : {Vector{1, 0}, Vector{0, 1}}) {
      Positions ahead = drop.points, behind = drop.points;
      ahead[k] += step * direction;
      behind[k] -= step * direction;
      const double gradient = (total_area(drop.curves, ahead) - total_area(drop.curves, behind)) / (2 * step);
      EXPECT_NEAR(dot(forces[k] - Vector{1.0, 2.0}, direction), pressure * gradient, 1e-9 * pressure * spacing) << k;
    }
  }
}

// Jittered, with a hole.
TEST(PressureForce, HasNeitherNetForceNorTorqueRoundAnyCurve) {
  const Drop drop = jittered_drop(12);
  ASSERT_GE(drop.curves.size(), 2u);
  std::vector<Vector> forces(drop.points.size());
  add_pressure_forces(drop.curves, drop.points, 144.0, forces);
  for (std::size_t c = 0; c < drop.curves.size(); ++c) {
    const auto curve = drop.curves.curve(c);
    Vector sum;
    double torque = 0, magnitude = 0;
    for (std::size_t k = curve.first; k < curve.last; ++k) {
      sum += forces[k];
      torque += cross(drop.points[k], forces[k]);
      magnitude += length(forces[k]);
    }
    EXPECT_LE(length(sum), 1e-14 * magnitude) << c;
    EXPECT_LE(std::abs(torque), 1e-14 * magnitude * 20 * spacing) << c;
  }
}

// On a regular polygon: sigma/(R cos(pi/n)), which is sigma/R of the circle within.
TEST(PressureForce, OfTheLaplacePressureBalancesTheTension) {
  const double radius = 5e-4;
  const int count = 126;
  const Positions points = ellipse(radius, radius, count);
  const SurfaceCurves curves = plain_curves({count});
  std::vector<Vector> forces(points.size());
  conservative_forces(curves, points, sigma, forces);
  const double tension = length(forces[0]);
  add_pressure_forces(curves, points, sigma / (radius * std::cos(std::numbers::pi / count)), forces);
  for (const Vector& force : forces) EXPECT_LE(length(force), 1e-12 * tension);
}

TEST(PressureForce, LeavesOutCurvesOfFewerThanThreeNodes) {
  const SurfaceCurves curves = plain_curves({2});
  const Positions points{{0, 0}, {spacing, 0}};
  std::vector<Vector> forces(2);
  add_pressure_forces(curves, points, 100.0, forces);
  EXPECT_EQ(forces[0], Vector{});
}

}  // namespace
}  // namespace sphdrop
