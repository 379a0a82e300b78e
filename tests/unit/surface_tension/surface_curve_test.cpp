#include "surface_tension/surface_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "drops.hpp"

namespace sphdrop {
namespace {

using namespace test;

/// Every arc is a node, each curve begins at its lowest particle, and curves come in the order of their beginnings.
void check_canonical(const SurfaceCurves& curves, const std::vector<Arc>& arcs) {
  EXPECT_EQ(curves.unmatched_arcs, 0);
  EXPECT_EQ(curves.nodes.size(), arcs.size());
  EXPECT_EQ(static_cast<std::size_t>(curves.curve_start.back()), arcs.size());
  std::multiset<std::int64_t> of_arcs, of_nodes;
  for (const Arc& arc : arcs) of_arcs.insert(arc.particle);
  for (const auto& node : curves.nodes) of_nodes.insert(node.particle);
  EXPECT_EQ(of_nodes, of_arcs);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last; ++k)
      EXPECT_LE(curves.nodes[curve.first].particle, curves.nodes[k].particle);
    if (c > 0) {
      EXPECT_LE(curves.nodes[curves.curve(c - 1).first].particle, curves.nodes[curve.first].particle);
    }
  }
}

/// The links of the curves are exactly those that the arcs ask for.
void check_links(const SurfaceCurves& curves, const std::vector<Arc>& arcs) {
  using Link = std::pair<std::int64_t, std::int64_t>;
  std::multiset<Link> asked, made;
  for (const Arc& arc : arcs) asked.insert({arc.particle, arc.next});
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto curve = curves.curve(c);
    for (std::size_t k = curve.first; k < curve.last; ++k)
      made.insert({curves.nodes[k].particle, curves.nodes[curve.next(k)].particle});
  }
  EXPECT_EQ(made, asked);
}

std::vector<double> areas_in_spacings(const SurfaceCurves& curves, const Positions& positions) {
  const Positions nodes = node_positions(curves, positions);
  std::vector<double> areas;
  for (std::size_t c = 0; c < curves.size(); ++c) areas.push_back(signed_area(curves, c, nodes) / (spacing * spacing));
  return areas;
}

bool same_curves(const SurfaceCurves& a, const SurfaceCurves& b) {
  return a.curve_start == b.curve_start &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), [](const auto& p, const auto& q) {
           return p.particle == q.particle && p.arc_direction == q.arc_direction;
         });
}

TEST(SurfaceCurve, OfADropIsOneCounterclockwiseCurve) {
  for (const Positions& positions : {ring_disc(20), lattice_disc(20.0), rectangle(20, 20)}) {
    const SurfaceCurves curves = curves_of(positions);
    check_canonical(curves, arcs_of(positions));
    check_links(curves, arcs_of(positions));
    ASSERT_EQ(curves.size(), 1U);
    EXPECT_GT(areas_in_spacings(curves, positions)[0], 0.0);
  }
}

TEST(SurfaceCurve, OfABlockRunsRoundItsRim) {
  const Positions positions = rectangle(11, 8);
  const SurfaceCurves curves = curves_of(positions);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves.nodes.size(), 2U * (11 + 8) - 4);
  EXPECT_NEAR(areas_in_spacings(curves, positions)[0], 10.0 * 7.0, 1e-9);
  for (std::size_t k = 0; k < curves.nodes.size(); ++k) EXPECT_NEAR(length(curves.nodes[k].arc_direction), 1.0, 1e-14);
  EXPECT_NEAR(curves.nodes[0].arc_direction.x, -std::sqrt(0.5), 1e-12);  // the corner at the origin
  EXPECT_NEAR(curves.nodes[0].arc_direction.y, -std::sqrt(0.5), 1e-12);
}

TEST(SurfaceCurve, OfAnAnnulusHasAClockwiseHole) {
  Positions positions = lattice(15, 0.5, [](double x, double y) {
    const double squared = x * x + y * y;
    return squared < 200 && squared > 36;
  });
  const SurfaceCurves curves = curves_of(positions);
  check_canonical(curves, arcs_of(positions));
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_NEAR(areas_in_spacings(curves, positions)[0], 200 * std::numbers::pi, 60.0);
  EXPECT_NEAR(areas_in_spacings(curves, positions)[1], -36 * std::numbers::pi, 30.0);
}

TEST(SurfaceCurve, DropsJoinWhereTheirCirclesMeet) {
  // The nearest particles of the two drops are `gap` apart, along a line through both centres.
  const Positions drop = ring_disc(8);
  const double width = 2.0 * 7.5 * spacing;
  for (const double gap : {2.5, 3.0, 3.5, 3.9, 4.1, 6.0}) {
    const Positions positions = together(drop, moved(drop, {width + gap * smoothing_length, 0.0}));
    const SurfaceCurves curves = curves_of(positions);
    check_canonical(curves, arcs_of(positions));
    check_links(curves, arcs_of(positions));
    ASSERT_EQ(curves.size(), gap < 4.0 ? 1U : 2U) << gap;
    for (const double area : areas_in_spacings(curves, positions)) EXPECT_GT(area, 0.0);
  }
}

TEST(SurfaceCurve, RunsAlongBothSidesOfAChain) {
  const Positions positions = rectangle(10, 1);
  const SurfaceCurves curves = curves_of(positions);
  check_links(curves, arcs_of(positions));
  ASSERT_EQ(curves.size(), 1U);
  std::vector<std::int64_t> visited;
  for (const auto& node : curves.nodes) visited.push_back(node.particle);
  EXPECT_EQ(visited, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 8, 7, 6, 5, 4, 3, 2, 1}));
  EXPECT_NEAR(curves.nodes[0].arc_direction.x, -1.0, 1e-12);
  EXPECT_NEAR(curves.nodes[4].arc_direction.y, -1.0, 1e-12);  // along the lower side first: counterclockwise
  EXPECT_NEAR(curves.nodes[9].arc_direction.x, 1.0, 1e-12);
  EXPECT_NEAR(curves.nodes[14].arc_direction.y, 1.0, 1e-12);
}

TEST(SurfaceCurve, RunsRoundAStripOfTwoParticles) {
  const Positions positions = rectangle(10, 2);
  const SurfaceCurves curves = curves_of(positions);
  check_links(curves, arcs_of(positions));
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves.nodes.size(), 20U);
  EXPECT_NEAR(areas_in_spacings(curves, positions)[0], 9.0, 1e-9);
}

TEST(SurfaceCurve, KeepsCurvesOfOneAndTwoNodes) {
  const Positions positions = {{0.0, 0.0}, {20.0 * spacing, 0.0}, {21.0 * spacing, 0.0}};
  const SurfaceCurves curves = curves_of(positions);
  check_canonical(curves, arcs_of(positions));
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves.curve(0).size(), 1U);
  EXPECT_EQ(curves.curve(1).size(), 2U);
  EXPECT_FALSE(curves.curve(0).carries_force());
  EXPECT_FALSE(curves.curve(1).carries_force());
  EXPECT_NEAR(curves.nodes[1].arc_direction.x, -1.0, 1e-12);
  EXPECT_NEAR(curves.nodes[2].arc_direction.x, 1.0, 1e-12);
}

TEST(SurfaceCurve, OfNothingIsEmpty) {
  const SurfaceCurves curves = connect_arcs({}, {}, circle_radius);
  EXPECT_EQ(curves.size(), 0U);
  EXPECT_EQ(curves.curve_start, std::vector<std::int32_t>{0});
}

TEST(SurfaceCurve, PassesBetweenTheOuterTwoOfThreeCirclesThroughOnePoint) {
  // All three are exactly 5 spacings from the origin, where the middle one's upper arc shrinks to nothing.
  const Positions positions = {{-3 * spacing, -4 * spacing}, {0.0, -5 * spacing}, {3 * spacing, -4 * spacing}};
  for (const double scale : {1.0, 1.0 - 1e-13, 1.0 + 1e-13}) {
    const std::vector<Arc> arcs = arcs_of(positions, 5.0 * spacing * scale);
    EXPECT_EQ(arcs.size(), 3U);
    const SurfaceCurves curves = curves_of(positions, 5.0 * spacing * scale);
    check_canonical(curves, arcs);
    check_links(curves, arcs);
    EXPECT_EQ(curves.size(), 1U);
  }
}

TEST(SurfaceCurve, ClosesOnLatticesForEveryRadius) {
  // Radii at which many circles of a lattice meet in common points.
  const Positions blocks = lattice(14, 0.0, [](double x, double y) {
    return std::max(std::abs(x), std::abs(y)) < 13 && !(x > 2 && y > -3 && y < 8) && x * x + y * y > 30;
  });
  for (const double radius :
       {1.0, std::sqrt(1.25), std::sqrt(2.0), 1.5, 2.0, std::sqrt(5.0), 2.4, 2.5, 3.0, 3.25, 5.0}) {
    const std::vector<Arc> arcs = arcs_of(blocks, radius * spacing);
    const SurfaceCurves curves = curves_of(blocks, radius * spacing);
    check_canonical(curves, arcs);
    check_links(curves, arcs);
  }
}

TEST(SurfaceCurve, ClosesForRandomArrangements) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Positions positions = lattice_disc(7.0);
    jitter(positions, (seed % 2 == 0 ? 0.05 : 0.45) * spacing, seed);
    if (seed % 4 == 3) {  // spray: loose particles, thin necks and holes
      positions.resize(40);
      jitter(positions, 5.0 * spacing, seed + 1000);
    }
    const std::vector<Arc> arcs = arcs_of(positions);
    const SurfaceCurves curves = curves_of(positions);
    check_canonical(curves, arcs);
    check_links(curves, arcs);
    if (seed % 4 != 3) {
      EXPECT_EQ(curves.size(), 1U) << seed;
    }
  }
}

TEST(SurfaceCurve, DoesNotDependOnTheOrderOfTheArcs) {
  std::mt19937 generator(3);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Positions positions(60);
    jitter(positions, 10.0 * spacing, seed);
    std::vector<Arc> arcs = arcs_of(positions);
    const SurfaceCurves expected = curves_of(positions);
    std::shuffle(arcs.begin(), arcs.end(), generator);
    Positions centres;
    for (const Arc& arc : arcs) centres.push_back(positions[static_cast<std::size_t>(arc.particle)]);
    EXPECT_TRUE(same_curves(connect_arcs(arcs, centres, circle_radius), expected)) << seed;
  }
}

TEST(SurfaceCurve, JoinsArcsWithWrongNeighboursWhereTheyMeet) {
  const Positions positions = rectangle(6, 6);
  std::vector<Arc> arcs = arcs_of(positions);
  Positions centres;
  for (const Arc& arc : arcs) centres.push_back(positions[static_cast<std::size_t>(arc.particle)]);
  const SurfaceCurves expected = connect_arcs(arcs, centres, circle_radius);
  arcs[3].next = 14;
  arcs[7].previous = 21;
  const SurfaceCurves curves = connect_arcs(arcs, centres, circle_radius);
  EXPECT_EQ(curves.unmatched_arcs, 0);
  EXPECT_TRUE(same_curves(curves, expected));
}

TEST(SurfaceCurve, ReportsMissingArcsAndStillCloses) {
  const Positions positions = rectangle(6, 6);
  std::vector<Arc> arcs = arcs_of(positions);
  arcs.erase(arcs.begin() + 4);
  arcs.erase(arcs.begin() + 11);
  Positions centres;
  for (const Arc& arc : arcs) centres.push_back(positions[static_cast<std::size_t>(arc.particle)]);
  const SurfaceCurves curves = connect_arcs(arcs, centres, circle_radius);
  EXPECT_EQ(curves.unmatched_arcs, 2);
  EXPECT_EQ(curves.nodes.size(), arcs.size());
  EXPECT_EQ(static_cast<std::size_t>(curves.curve_start.back()), arcs.size());
}

TEST(SurfaceCurve, FollowsAnArcOnlyOnce) {
  const Positions positions = rectangle(6, 6);
  std::vector<Arc> arcs = arcs_of(positions);
  const std::size_t rim = arcs.size();
  arcs.push_back(arcs[4]);
  Positions centres;
  for (const Arc& arc : arcs) centres.push_back(positions[static_cast<std::size_t>(arc.particle)]);
  const SurfaceCurves curves = connect_arcs(arcs, centres, circle_radius);
  EXPECT_EQ(curves.unmatched_arcs, 1);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves.curve(0).size(), rim);
  EXPECT_EQ(curves.curve(1).size(), 1U);
}

}  // namespace
}  // namespace sphdrop
