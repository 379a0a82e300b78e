#include "surface_tension/boundary_detection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "drops.hpp"

namespace sphdrop {
namespace {

using namespace test;

/// Whether direction (angle) of particle i is covered, from the definition: is the point on its circle inside
/// another's? Positive inside, by how much (m).
double depth_of_cover(const Positions& positions, std::size_t i, double angle, double radius) {
  const Vector point = positions[i] + radius * Vector{std::cos(angle), std::sin(angle)};
  double depth = -1.0;
  for (std::size_t j = 0; j < positions.size(); ++j)
    if (j != i) depth = std::max(depth, radius - length(point - positions[j]));
  return depth;
}

bool is_within(const Arc& arc, double angle) {
  const auto from = std::atan2(arc.start.y, arc.start.x);
  const auto turn = [](double a) { return a < 0.0 ? a + 2.0 * std::numbers::pi : a; };
  if (arc.start == arc.end) return true;
  return turn(std::remainder(angle - from, 2.0 * std::numbers::pi)) <
         turn(std::remainder(std::atan2(arc.end.y, arc.end.x) - from, 2.0 * std::numbers::pi));
}

/// Compares with sampled directions; those too near a circle's rim to tell are left out. Returns how many were
/// compared.
int compare_with_sampling(const Positions& positions, double radius = circle_radius) {
  const std::vector<Arc> arcs = arcs_of(positions, radius);
  constexpr int samples = 360;
  int compared = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int k = 0; k < samples; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.37) / samples;
      const double depth = depth_of_cover(positions, i, angle, radius);
      if (std::abs(depth) < 1e-7 * radius) continue;
      ++compared;
      const auto holding = std::count_if(arcs.begin(), arcs.end(), [&](const Arc& arc) {
        return arc.particle == static_cast<std::int64_t>(i) && is_within(arc, angle);
      });
      EXPECT_EQ(holding, depth > 0.0 ? 0 : 1) << "particle " << i << " at angle " << angle;
    }
  }
  return compared;
}

/// The ends of arcs lie on the circles of `previous` and `next`, coming out of the one and into the other.
void check_ends(const Positions& positions, const std::vector<Arc>& arcs, double radius = circle_radius) {
  for (const Arc& arc : arcs) {
    const auto at = [&](std::int64_t id) { return positions[static_cast<std::size_t>(id)]; };
    EXPECT_NEAR(length(arc.start), 1.0, 1e-14);
    EXPECT_NEAR(length(arc.end), 1.0, 1e-14);
    if (arc.previous == arc.particle) continue;
    EXPECT_NEAR(length(at(arc.particle) + radius * arc.start - at(arc.previous)), radius, 1e-13 * radius);
    EXPECT_NEAR(length(at(arc.particle) + radius * arc.end - at(arc.next)), radius, 1e-13 * radius);
    EXPECT_LT(cross(arc.start, at(arc.previous) - at(arc.particle)), 0.0);
    EXPECT_GT(cross(arc.end, at(arc.next) - at(arc.particle)), 0.0);
  }
}

std::set<std::int64_t> particles_of(const std::vector<Arc>& arcs) {
  std::set<std::int64_t> particles;
  for (const Arc& arc : arcs) particles.insert(arc.particle);
  return particles;
}

TEST(BoundaryDetection, AgreesWithSampledDirections) {
  Positions irregular = lattice_disc(6.0);
  jitter(irregular, 0.3 * spacing, 7);
  const Positions holed = lattice(8, 0.0, [](double x, double y) { return x * x + y * y < 64 && x * x + y * y > 16; });
  for (const Positions& positions :
       {irregular, holed, ring_disc(6), rectangle(9, 7), rectangle(12, 1), rectangle(12, 2),
        together(lattice_disc(3.0), moved(lattice_disc(3.0), {8.7 * spacing, 0.0}))}) {
    EXPECT_GT(compare_with_sampling(positions), 300 * static_cast<int>(positions.size()));
    check_ends(positions, arcs_of(positions));
  }
}

TEST(BoundaryDetection, AgreesWithSampledDirectionsForScatteredParticles) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Positions positions(30);
    jitter(positions, 8.0 * spacing, seed);
    compare_with_sampling(positions);
    check_ends(positions, arcs_of(positions));
  }
}

TEST(BoundaryDetection, FindsTheOuterRingOfADrop) {
  const Positions positions = ring_disc(20);
  const auto found = particles_of(arcs_of(positions));
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_EQ(found.contains(static_cast<std::int64_t>(i)), length(positions[i]) > 19.2 * spacing) << i;
}

TEST(BoundaryDetection, FindsTheRimOfARectangle) {
  const Positions positions = rectangle(11, 8);
  const auto found = particles_of(arcs_of(positions));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::size_t column = i / 8;
    const std::size_t row = i % 8;
    EXPECT_EQ(found.contains(static_cast<std::int64_t>(i)), column == 0 || column == 10 || row == 0 || row == 7) << i;
  }
}

TEST(BoundaryDetection, GivesAnIsolatedParticleItsWholeCircle) {
  const std::vector<Arc> arcs = arcs_of({{0.0, 0.0}, {2.001 * circle_radius, 0.0}});
  ASSERT_EQ(arcs.size(), 2U);
  for (std::int64_t i = 0; i < 2; ++i) {
    const Arc& arc = arcs[static_cast<std::size_t>(i)];
    EXPECT_EQ(arc.particle, i);
    EXPECT_EQ(arc.previous, i);
    EXPECT_EQ(arc.next, i);
    EXPECT_EQ(arc.start, arc.end);
    EXPECT_DOUBLE_EQ(length(arc.start), 1.0);
  }
}

TEST(BoundaryDetection, GivesEachOfAPairOneArc) {
  for (const double distance : {0.01, 0.5, 1.0, 1.9, 1.999999}) {
    const Positions positions = {{0.0, 0.0}, {distance * circle_radius, 0.0}};
    const std::vector<Arc> arcs = arcs_of(positions);
    ASSERT_EQ(arcs.size(), 2U) << distance;
    EXPECT_EQ(arcs[0].previous, 1);
    EXPECT_EQ(arcs[0].next, 1);
    EXPECT_NEAR(arcs[0].start.x, 0.5 * distance, 1e-12);
    EXPECT_GT(arcs[0].start.y, 0.0);
    EXPECT_NEAR(arcs[0].end.x, 0.5 * distance, 1e-12);
    EXPECT_LT(arcs[0].end.y, 0.0);
    check_ends(positions, arcs);
  }
}

TEST(BoundaryDetection, CirclesThatOnlyTouchDoNotCover) {
  for (const Arc& arc : arcs_of({{0.0, 0.0}, {2.0 * circle_radius, 0.0}})) EXPECT_EQ(arc.previous, arc.particle);
}

TEST(BoundaryDetection, GivesParticlesOfAChainTwoArcs) {
  const std::vector<Arc> arcs = arcs_of(rectangle(10, 1));
  EXPECT_EQ(arcs.size(), 18U);
  for (std::int64_t i = 0; i < 10; ++i)
    EXPECT_EQ(std::count_if(arcs.begin(), arcs.end(), [&](const Arc& arc) { return arc.particle == i; }),
              i == 0 || i == 9 ? 1 : 2);
}

TEST(BoundaryDetection, CountsNeighboursOutToFourSmoothingLengths) {
  // A gap of 3h: outside the kernel, yet each side covers part of the other's circles.
  const Positions positions = {{0.0, 0.0}, {3.0 * smoothing_length, 0.0}};
  EXPECT_EQ(arcs_of(positions)[0].previous, 1);
}

TEST(BoundaryDetection, CoversSliversWhereCirclesMeetInAPoint) {
  // Twelve lattice points exactly 5 spacings from the origin: with radius 5 their circles close over it.
  const Positions positions =
      lattice(12, 0.0, [](double x, double y) { return x * x + y * y >= 25 && x * x + y * y < 120; });
  const auto inner = [&](double radius) {
    const std::vector<Arc> arcs = arcs_of(positions, radius * spacing);
    return std::count_if(arcs.begin(), arcs.end(), [&](const Arc& arc) {
      return length(positions[static_cast<std::size_t>(arc.particle)]) < 5.5 * spacing;
    });
  };
  EXPECT_EQ(inner(5.0), 0);
  EXPECT_EQ(inner(5.0 * (1.0 - 1e-12)), 0);
  EXPECT_EQ(inner(5.0 * (1.0 - 1e-6)), 12);
}

TEST(BoundaryDetection, DoesNotDependOnTheOrderOfTheNeighbours) {
  Positions positions = rectangle(7, 7);  // many neighbours at equal distances
  std::vector<std::int64_t> ids(positions.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i);
  for (const double radius : {circle_radius, 2.5 * spacing}) {
    const std::vector<Arc> expected = arcs_of(positions, radius);
    std::mt19937 generator(1);
    for (int round = 0; round < 20; ++round) {
      std::shuffle(ids.begin(), ids.end(), generator);
      Positions shuffled;
      for (const auto id : ids) shuffled.push_back(positions[static_cast<std::size_t>(id)]);
      std::vector<Arc> arcs;
      ArcFinder own_finder(radius);
      for (std::size_t i = 0; i < positions.size(); ++i)
        own_finder.find(static_cast<std::int64_t>(i), positions[i], ids, shuffled, arcs);
      ASSERT_EQ(arcs.size(), expected.size());
      for (std::size_t k = 0; k < arcs.size(); ++k) {
        EXPECT_EQ(arcs[k].particle, expected[k].particle);
        EXPECT_EQ(arcs[k].previous, expected[k].previous);
        EXPECT_EQ(arcs[k].next, expected[k].next);
        EXPECT_EQ(arcs[k].start, expected[k].start);
        EXPECT_EQ(arcs[k].end, expected[k].end);
      }
    }
  }
}

TEST(BoundaryDetection, OfCoincidentParticlesOnlyTheLowestHasArcs) {
  Positions positions = rectangle(6, 1);
  positions.push_back(positions[2]);
  const std::vector<Arc> arcs = arcs_of(positions);
  const std::vector<Arc> expected = arcs_of(rectangle(6, 1));
  ASSERT_EQ(arcs.size(), expected.size());
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    EXPECT_EQ(arcs[k].particle, expected[k].particle);
    EXPECT_EQ(arcs[k].previous, expected[k].previous);
    EXPECT_EQ(arcs[k].next, expected[k].next);
  }
}

}  // namespace
}  // namespace sphdrop
