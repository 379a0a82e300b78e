#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "contact/foot_point.hpp"

namespace sphdrop {
namespace {

/// A polyline with all its segments as candidates.
class Boundary {
 public:
  explicit Boundary(const std::vector<Vector>& vertices) {
    std::vector<std::int32_t> line;
    for (const Vector& vertex : vertices) {
      line.push_back(static_cast<std::int32_t>(x_.size()));
      x_.push_back(vertex.x);
      y_.push_back(vertex.y);
    }
    segments_ = segments_of_polylines(std::vector<std::vector<std::int32_t>>{line});
    all_.resize(segments_.size());
    std::iota(all_.begin(), all_.end(), 0);
  }
  FootPoint nearest(Vector x) const { return nearest_foot_point(x, all_, {segments_, x_, y_}); }
  Vector position(const FootPoint& foot) const {
    const ContactSurface surface{segments_, x_, y_};
    const Segment& s = segments_[foot.segment];
    return (1 - foot.fraction) * surface.vertex(s.first) + foot.fraction * surface.vertex(s.second);
  }

 private:
  std::vector<double> x_, y_;
  std::vector<Segment> segments_;
  std::vector<std::int32_t> all_;
};

void expect_vector(Vector actual, Vector expected) {
  EXPECT_NEAR(actual.x, expected.x, 1e-14);
  EXPECT_NEAR(actual.y, expected.y, 1e-14);
}

// The end of a cantilever: over the top, down the free end, back along the underside.
const Boundary tip({{0, 1}, {1, 1}, {2, 1}, {2, 0}, {1, 0}, {0, 0}});
// A clamp's face meeting the top of the beam: a concave corner at (0, 0).
const Boundary corner({{-1, 2}, {0, 2}, {0, 1}, {0, 0}, {1, 0}, {2, 0}});

TEST(FootPoint, LiesOnTheSegmentUnderTheParticle) {
  const FootPoint foot = tip.nearest({1.25, 1.5});
  EXPECT_EQ(foot.segment, 1);
  EXPECT_FALSE(foot.at_vertex);
  EXPECT_DOUBLE_EQ(foot.fraction, 0.25);
  EXPECT_DOUBLE_EQ(foot.distance, 0.5);
  expect_vector(foot.normal, {0, 1});
}

TEST(FootPoint, NormalsPointOutwardOnEverySide) {
  expect_vector(tip.nearest({0.5, 1.3}).normal, {0, 1});
  expect_vector(tip.nearest({2.3, 0.4}).normal, {1, 0});
  expect_vector(tip.nearest({0.5, -0.3}).normal, {0, -1});
  EXPECT_NEAR(tip.nearest({2.3, 0.4}).distance, 0.3, 1e-14);
  EXPECT_NEAR(tip.nearest({0.5, -0.3}).distance, 0.3, 1e-14);
}

TEST(FootPoint, IsNegativeInsideTheSolid) {
  const FootPoint below_top = tip.nearest({0.5, 0.9});
  EXPECT_NEAR(below_top.distance, -0.1, 1e-14);
  expect_vector(below_top.normal, {0, 1});
  const FootPoint above_underside = tip.nearest({0.5, 0.1});
  EXPECT_NEAR(above_underside.distance, -0.1, 1e-14);
  expect_vector(above_underside.normal, {0, -1});
  const FootPoint behind_end = tip.nearest({1.95, 0.5});
  EXPECT_NEAR(behind_end.distance, -0.05, 1e-14);
  expect_vector(behind_end.normal, {1, 0});
}

TEST(FootPoint, IsRadialAndPositiveAtAConvexVertex) {
  const FootPoint foot = tip.nearest({2.3, 1.4});
  EXPECT_TRUE(foot.at_vertex);
  EXPECT_EQ(foot.segment, 1);  // of the two that meet there, the lower
  EXPECT_EQ(foot.fraction, 1.0);
  EXPECT_NEAR(foot.distance, 0.5, 1e-14);
  expect_vector(foot.normal, {0.6, 0.8});
}

TEST(FootPoint, IsRadialAndNegativeAtAConcaveVertex) {
  // The solid fills everything to the left of and below the corner, so this particle is 0.5 deep inside.
  const FootPoint foot = corner.nearest({-0.3, -0.4});
  EXPECT_TRUE(foot.at_vertex);
  EXPECT_NEAR(foot.distance, -0.5, 1e-14);
  expect_vector(foot.normal, {0.6, 0.8});  // outward: from the particle to the corner
}

TEST(FootPoint, KnowsGentleConcaveAndConvexTurns) {
  const Boundary valley({{-1, 0.1}, {0, 0}, {1, 0.1}});
  const FootPoint under_valley = valley.nearest({0.001, -0.2});
  EXPECT_TRUE(under_valley.at_vertex);
  EXPECT_NEAR(under_valley.distance, -length({0.001, -0.2}), 1e-14);
  EXPECT_GT(under_valley.normal.y, 0.99);
  const Boundary ridge({{-1, -0.1}, {0, 0}, {1, -0.1}});
  const FootPoint over_ridge = ridge.nearest({0.001, 0.2});
  EXPECT_TRUE(over_ridge.at_vertex);
  EXPECT_NEAR(over_ridge.distance, length({0.001, 0.2}), 1e-14);
  EXPECT_GT(over_ridge.normal.y, 0.99);
}

TEST(FootPoint, DoesNotMistakeTheSideWhereTheBoundaryIsStraightUpToRounding) {
  // Vertices of a tilted straight line do not lie on it exactly: whether one counts as convex is a matter of rounding,
  // the side of a particle on the perpendicular through it is not.
  std::vector<Vector> vertices;
  for (int k = 0; k < 200; ++k) vertices.push_back({k * 0.1 * 0.8, k * 0.1 * 0.6});
  const Boundary line(vertices);
  for (int k = 1; k < 199; ++k) {
    for (const double offset : {0.03, -0.03}) {
      const FootPoint foot = line.nearest(vertices[k] + offset * Vector{-0.6, 0.8});
      EXPECT_NEAR(foot.distance, offset, 1e-13) << k;
      EXPECT_NEAR(dot(foot.normal, Vector{-0.6, 0.8}), 1.0, 1e-12) << k;
    }
  }
}

TEST(FootPoint, IsPositiveBeyondAFreeEnd) {
  for (const Vector x : {Vector{-0.3, 1.4}, Vector{-0.3, 0.6}}) {
    const FootPoint foot = tip.nearest(x);
    EXPECT_TRUE(foot.at_vertex);
    EXPECT_EQ(foot.segment, 0);
    EXPECT_EQ(foot.fraction, 0.0);
    EXPECT_NEAR(foot.distance, 0.5, 1e-14);
    expect_vector(foot.normal, (x - Vector{0, 1}) / 0.5);
  }
}

TEST(FootPoint, OnTheBoundaryHasTheSegmentsNormal) {
  const FootPoint inside = tip.nearest({0.5, 1});
  EXPECT_EQ(inside.distance, 0.0);
  expect_vector(inside.normal, {0, 1});
  const FootPoint vertex = tip.nearest({2, 1});
  EXPECT_EQ(vertex.distance, 0.0);
  expect_vector(vertex.normal, {0, 1});
  const FootPoint end = tip.nearest({0, 1});
  EXPECT_EQ(end.distance, 0.0);
  expect_vector(end.normal, {0, 1});
}

TEST(FootPoint, BreaksTiesTowardTheLowerSegment) {
  // Equally far from both faces of the corner, and from top and underside of the beam.
  EXPECT_EQ(corner.nearest({0.25, 0.25}).segment, 2);
  EXPECT_EQ(tip.nearest({0.5, 0.5}).segment, 0);
}

TEST(FootPoint, SurvivesCoincidentVertices) {
  const Boundary degenerate({{0, 0}, {1, 0}, {1, 0}, {2, 0}});
  const FootPoint above = degenerate.nearest({1, 0.5});
  EXPECT_NEAR(above.distance, 0.5, 1e-14);
  expect_vector(above.normal, {0, 1});
  const FootPoint on_it = degenerate.nearest({1, 0});
  EXPECT_EQ(on_it.distance, 0.0);
  EXPECT_FALSE(std::isnan(on_it.normal.x + on_it.normal.y));
  const Boundary begins_with_a_point({{1, 0}, {1, 0}, {2, 0}});
  const FootPoint on_point = begins_with_a_point.nearest({1, 0});
  EXPECT_EQ(on_point.distance, 0.0);
  EXPECT_EQ(on_point.normal, Vector{});
}

TEST(FootPoint, WithoutCandidatesHasNoSegment) {
  EXPECT_EQ(nearest_foot_point({0, 0}, {}, ContactSurface{}).segment, -1);
}

TEST(FootPoint, IsTheNearestPointOfAWavyBoundary) {
  // Against brute force: no sampled point of the boundary is nearer, and the normal leads from foot point to particle.
  std::vector<Vector> vertices;
  for (int k = 0; k <= 40; ++k) vertices.push_back({0.1 * k, 0.3 * std::sin(0.4 * k)});
  const Boundary wave(vertices);
  for (int i = 0; i < 60; ++i) {
    const Vector x{0.07 * i - 0.1, 0.45 * std::cos(1.3 * i)};
    const FootPoint foot = wave.nearest(x);
    double sampled = 1e9;
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k)
      for (int f = 0; f <= 200; ++f)
        sampled = std::min(sampled, length(x - (vertices[k] + f / 200.0 * (vertices[k + 1] - vertices[k]))));
    EXPECT_LE(std::abs(foot.distance), sampled + 1e-14);
    EXPECT_GE(std::abs(foot.distance), sampled - 1e-3);
    expect_vector(wave.position(foot) + foot.distance * foot.normal, x);
    EXPECT_NEAR(length(foot.normal), 1.0, 1e-14);
    const bool is_far_from_the_free_ends = x.x > 0.7 && x.x < 3.3;
    if (is_far_from_the_free_ends) {
      const auto k = static_cast<std::size_t>(x.x / 0.1);
      const double slope = (vertices[k + 1].y - vertices[k].y) / 0.1;
      const double height = vertices[k].y + slope * (x.x - vertices[k].x);
      EXPECT_EQ(foot.distance > 0, x.y > height) << i;
    }
  }
}

}  // namespace
}  // namespace sphdrop
