// The forces of adhesion against finite differences of its energy -W B, and what follows from their being a gradient.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "surface_tension/surface_force.hpp"
#include "tests/support/random_numbers.hpp"
#include "wetting/adhesion.hpp"

namespace sphdrop {
namespace {

constexpr double d = 2.5e-5, sigma = 0.072;
constexpr AdhesionParameters parameters{.work = 0.1, .spacing = d, .rest_distance = 0.5 * d};

/// y of the wall at x.
using Shape = std::function<double(double)>;

double straight(double) {
  return 0.0;
}
double hollow(double x) {
  return 8e2 * x * x;
}
double bulging(double x) {
  return -8e2 * x * x;
}
double sloping(double x) {
  return 0.7 * x;
}

/// A closed curve beside a wall, with forces on both.
struct Scene {
  SurfaceCurves curves;
  std::vector<Vector> points, forces;
  std::vector<double> vertex_x, vertex_y, force_x, force_y;
  std::vector<Segment> segments;
  Adhesion adhesion;

  /// A wall of uneven segments from -half to half, the solid below, and above it no liquid yet.
  Scene(const Shape& wall, double half, std::uint64_t seed) {
    test::RandomNumbers random(seed);
    std::vector<std::int32_t> line;
    for (double x = -half; x < half; x += random.between(0.8, 1.2) * d) {
      line.push_back(static_cast<std::int32_t>(vertex_x.size()));
      vertex_x.push_back(x);
      vertex_y.push_back(wall(x));
    }
    segments = segments_of_polylines(std::vector<std::vector<std::int32_t>>{line});
    force_x.assign(vertex_x.size(), 0.0);
    force_y.assign(vertex_x.size(), 0.0);
  }

  void add_curve(const std::vector<Vector>& curve) {
    points.insert(points.end(), curve.begin(), curve.end());
    curves.nodes.resize(points.size());
    curves.curve_start.push_back(static_cast<std::int32_t>(points.size()));
    forces.assign(points.size(), {});
    adhesion.rebuild(points, surface(), parameters.range() + 2 * d);
  }

  ContactSurface surface() const { return {segments, vertex_x, vertex_y}; }
  double width() { return adhesion.base_width(curves, points, surface(), parameters); }
  AdhesionSummary apply() {
    std::fill(forces.begin(), forces.end(), Vector{});
    std::fill(force_x.begin(), force_x.end(), 0.0);
    std::fill(force_y.begin(), force_y.end(), 0.0);
    return adhesion.apply(curves, points, segments, {vertex_x, vertex_y, force_x, force_y}, parameters, forces);
  }
};

/// A rough oval whose underside follows the wall at uneven gaps, from resting to beyond the range.
std::vector<Vector> rough_oval(const Shape& wall, Vector centre, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<Vector> curve;
  constexpr int nodes = 60;
  for (int k = 0; k < nodes; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / nodes, radius = 10 * d;
    Vector p = centre + radius * Vector{std::cos(angle), 0.6 * std::sin(angle)};
    p += random.in_box({-0.3 * d, -0.3 * d}, {0.3 * d, 0.3 * d});
    const double lowest = wall(p.x) + random.between(0.4, 1.6) * d;
    p.y = std::max(p.y, lowest);
    curve.push_back(p);
  }
  return curve;
}

/// Every force on liquid and solid against the change of -W B, as far as B is smooth there: a point may not change the
/// segment it is nearest to.
void expect_gradient(Scene& scene) {
  const double step = 1e-5 * d, scale = parameters.work;
  scene.apply();
  const std::vector<Vector> forces = scene.forces;
  const std::vector<double> force_x = scene.force_x, force_y = scene.force_y;
  const auto slope = [&](double& value) {
    const double there = value;
    value = there + step;
    const double above = scene.width();
    value = there - step;
    const double below = scene.width();
    value = there;
    return parameters.work * (above - below) / (2.0 * step);
  };
  double largest = 0;
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    EXPECT_NEAR(forces[k].x, slope(scene.points[k].x), 1e-6 * scale) << "point " << k;
    EXPECT_NEAR(forces[k].y, slope(scene.points[k].y), 1e-6 * scale) << "point " << k;
    largest = std::max(largest, length(forces[k]));
  }
  EXPECT_GT(largest, 0.2 * scale);
  double largest_on_solid = 0;
  for (std::size_t v = 0; v < scene.vertex_x.size(); ++v) {
    EXPECT_NEAR(force_x[v], slope(scene.vertex_x[v]), 1e-6 * scale) << "vertex " << v;
    EXPECT_NEAR(force_y[v], slope(scene.vertex_y[v]), 1e-6 * scale) << "vertex " << v;
    largest_on_solid = std::max(largest_on_solid, std::hypot(force_x[v], force_y[v]));
  }
  EXPECT_GT(largest_on_solid, 0.1 * scale);
}

struct Balance {
  Vector force;
  double moment = 0, magnitude = 0;
  Vector on_solid;
  double moment_on_solid = 0;
};

Balance balance_of(const Scene& scene) {
  Balance b;
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    b.force += scene.forces[k];
    b.moment += cross(scene.points[k], scene.forces[k]);
    b.magnitude += length(scene.forces[k]);
  }
  for (std::size_t v = 0; v < scene.vertex_x.size(); ++v) {
    const Vector force{scene.force_x[v], scene.force_y[v]};
    b.on_solid += force;
    b.moment_on_solid += cross({scene.vertex_x[v], scene.vertex_y[v]}, force);
    b.magnitude += length(force);
  }
  b.force += b.on_solid;
  b.moment += b.moment_on_solid;
  return b;
}

TEST(ContactAngle, GivesTheWorkOfAdhesionOfYoungAndDupre) {
  EXPECT_EQ(work_of_adhesion(sigma, 180.0), 0.0);
  EXPECT_NEAR(work_of_adhesion(sigma, 90.0), sigma, 1e-16);
  EXPECT_NEAR(work_of_adhesion(sigma, 60.0), 1.5 * sigma, 1e-16);
  EXPECT_NEAR(work_of_adhesion(sigma, 120.0), 0.5 * sigma, 1e-16);
  EXPECT_NEAR(work_of_adhesion(sigma, 1e-6), 2.0 * sigma, 1e-15);
}

TEST(BaseWeight, FallsSmoothlyFromOneToZero) {
  EXPECT_EQ(base_weight(-3 * d, d).value, 1.0);
  EXPECT_EQ(base_weight(0.25 * d, d).value, 1.0);
  EXPECT_EQ(base_weight(2 * d, d).value, 0.0);
  EXPECT_EQ(base_weight(9 * d, d).slope, 0.0);
  EXPECT_NEAR(base_weight(1.125 * d, d).value, 0.5, 1e-15);
  const double step = 1e-5 * d;
  for (const double gap : {0.1, 0.26, 0.6, 1.1, 1.7, 1.99, 2.3}) {
    const double slope = (base_weight(gap * d + step, d).value - base_weight(gap * d - step, d).value) / (2 * step);
    EXPECT_NEAR(base_weight(gap * d, d).slope * d, slope * d, 1e-6) << gap;
  }
}

TEST(Adhesion, IsTheGradientOfTheBasesWidthOverStraightAndBentWalls) {
  std::uint64_t seed = 1;
  for (const Shape& wall : {Shape(straight), Shape(hollow), Shape(bulging), Shape(sloping)})
    for (int repeat = 0; repeat < 3; ++repeat, ++seed) {
      SCOPED_TRACE(seed);
      Scene scene(wall, 30 * d, seed);
      scene.add_curve(rough_oval(wall, {0.3 * d, 4 * d}, seed + 100));
      expect_gradient(scene);
    }
}

// The end of a wall is one vertex for all points beyond it; so is each bend of a bulging wall for some.
TEST(Adhesion, IsTheGradientRoundTheEndOfAWallToo) {
  for (std::uint64_t seed = 31; seed < 35; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(straight, 30 * d, seed);
    const double end = scene.vertex_x.back();
    std::vector<Vector> curve;
    test::RandomNumbers random(seed);
    for (int k = 0; k < 24; ++k) {  // three quarters round the end, then back outside
      const double angle = -1.5 + 3.0 * k / 23.0;
      curve.push_back(Vector{end, 0} + random.between(0.5, 1.9) * d * Vector{std::cos(angle), -std::sin(angle)});
    }
    std::reverse(curve.begin(), curve.end());
    for (int k = 0; k < 20; ++k) {
      const double angle = -1.5 + 3.0 * k / 19.0;
      curve.push_back(Vector{end, 0} + 5.0 * d * Vector{std::cos(angle), -std::sin(angle)});
    }
    scene.add_curve(curve);
    expect_gradient(scene);
  }
}

TEST(Adhesion, KeepsLinearAndAngularMomentum) {
  std::uint64_t seed = 61;
  for (const Shape& wall : {Shape(straight), Shape(hollow), Shape(bulging), Shape(sloping)}) {
    Scene scene(wall, 30 * d, seed);
    scene.add_curve(rough_oval(wall, {0, 4 * d}, seed++));
    scene.add_curve(rough_oval(wall, {15 * d, wall(15 * d) + 4 * d}, seed++));
    const AdhesionSummary summary = scene.apply();
    const Balance b = balance_of(scene);
    EXPECT_GT(b.magnitude, parameters.work);
    EXPECT_LT(length(b.force), 1e-14 * b.magnitude);
    EXPECT_LT(std::abs(b.moment), 1e-14 * b.magnitude * 30 * d);
    EXPECT_LT(length(summary.force_on_solid - b.on_solid), 1e-14 * b.magnitude);
    EXPECT_LT(std::abs(summary.moment_on_solid - b.moment_on_solid), 1e-14 * b.magnitude * 30 * d);
    EXPECT_DOUBLE_EQ(summary.base_width, scene.width());
  }
}

/// A cap of that angle and base half width, flat on a straight wall at the rest distance, liquid on the left.
std::vector<Vector> cap(double angle, double half_width, int nodes) {
  std::vector<Vector> curve;
  const double radius = half_width / std::sin(angle), rest = parameters.rest_distance;
  const double arc = 2.0 * angle * radius, round = 2.0 * half_width + arc;
  for (int k = 0; k < nodes; ++k) {
    const double at = round * (k + 0.5) / nodes;
    if (at < 2.0 * half_width) {
      curve.push_back({at - half_width, rest});
    } else {
      const double along = angle - (at - 2.0 * half_width) / radius;  // from the right contact line over the top
      curve.push_back({radius * std::sin(along), rest + radius * (std::cos(along) - std::cos(angle))});
    }
  }
  return curve;
}

// Of a fine curve the base is what is within the weight's fall of the wall: as wide as the cap's, a little more where
// the cap rises within that.
TEST(Adhesion, SeesTheBaseOfACap) {
  for (const double angle : {60.0, 90.0, 120.0}) {
    Scene scene(straight, 60 * d, 91);
    scene.add_curve(cap(angle * std::numbers::pi / 180, 30 * d, 400));
    const double fall = 1.125 * d / std::tan(angle * std::numbers::pi / 180);  // half way down the weight
    EXPECT_NEAR(scene.width(), 2.0 * (30 * d - fall), 0.1 * d) << angle;
  }
}

// Along the wall the tension pulls a contact line back with sigma (1 + cos) and adhesion pulls it out with W: in
// balance at the contact angle, too little beyond it.
TEST(Adhesion, BalancesTensionAlongTheWallAtTheContactAngle) {
  for (const double angle : {50.0, 90.0, 130.0}) {
    for (const double off : {-10.0, 0.0, 10.0}) {
      Scene scene(straight, 60 * d, 92);
      scene.add_curve(cap((angle + off) * std::numbers::pi / 180, 30 * d, 800));
      scene.apply();
      std::vector<Vector> tension(scene.points.size());
      conservative_forces(scene.curves, scene.points, sigma, tension);
      const double adhesion = work_of_adhesion(sigma, angle) / parameters.work;
      double pull = 0;  // on all that lies right of the middle of the base and below a height above the weight's end
      for (std::size_t k = 0; k < scene.points.size(); ++k)
        if (scene.points[k].x > 0 && scene.points[k].y < 3 * d) pull += tension[k].x + adhesion * scene.forces[k].x;
      // The cap's tangent at the cut is a little flatter than at the wall.
      const double here = (angle + off) * std::numbers::pi / 180;
      const double radius = 30 * d / std::sin(here);
      const double at_cut = std::acos(std::cos(here) + 2.5 * d / radius);
      const double expected = sigma * (std::cos(angle * std::numbers::pi / 180) - std::cos(at_cut));
      EXPECT_NEAR(pull, expected, 0.02 * sigma) << angle << " + " << off;
    }
  }
}

TEST(Adhesion, FarFromTheWallThereIsNone) {
  Scene scene(straight, 30 * d, 93);
  scene.add_curve(rough_oval([](double) { return 2.6 * d; }, {0, 9 * d}, 94));
  EXPECT_EQ(scene.apply().base_width, 0.0);
  EXPECT_EQ(balance_of(scene).magnitude, 0.0);
}

TEST(Adhesion, HasTheSameBitsWhateverTheReach) {
  Scene scene(bulging, 30 * d, 95);
  scene.add_curve(rough_oval(bulging, {0, 4 * d}, 96));
  const double width = scene.apply().base_width;
  const std::vector<Vector> forces = scene.forces;
  const std::vector<double> force_y = scene.force_y;
  scene.adhesion.rebuild(scene.points, scene.surface(), parameters.range() + 20 * d);
  EXPECT_EQ(scene.apply().base_width, width);
  EXPECT_EQ(scene.forces, forces);
  EXPECT_EQ(scene.force_y, force_y);
}

}  // namespace
}  // namespace sphdrop
