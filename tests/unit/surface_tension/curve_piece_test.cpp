#include "surface_tension/curve_piece.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "drops.hpp"
#include "surface_tension/surface_force.hpp"
#include "surface_tension/surface_points.hpp"

namespace sphdrop {
namespace {

using namespace test;

// A ring with a hole, a pair and one alone: curves of many, of two and of one node.
Positions drops() {
  Positions positions = lattice(15, 0.5, [](double x, double y) {
    const double squared = x * x + 1.3 * y * y;
    return squared < 200 && squared > 36;
  });
  positions.push_back({40.0 * spacing, 0.0});
  positions.push_back({41.0 * spacing, 0.3 * spacing});
  positions.push_back({80.0 * spacing, 0.0});
  return positions;
}

struct Forces {
  Positions points, conservative, polynomial;
};

Forces forces_on(const SurfaceCurves& curves, const Positions& nodes) {
  Forces forces{Positions(nodes.size()), Positions(nodes.size()), Positions(nodes.size())};
  surface_points(curves, nodes, spacing, forces.points);
  conservative_forces(curves, forces.points, 0.07, forces.conservative);
  add_pressure_forces(curves, forces.points, 30.0, forces.conservative);
  curvature_forces(curves, forces.points, 0.07, 5, forces.polynomial);
  return forces;
}

// Bit for bit what the whole curve gives, at every wanted node.
TEST(CurvePiece, HasTheForcesOfTheWholeCurve) {
  const Positions positions = drops();
  const SurfaceCurves curves = curves_of(positions);
  const Positions nodes = node_positions(curves, positions);
  const Forces whole = forces_on(curves, nodes);
  std::mt19937_64 random(11);
  for (const double density : {0.02, 0.2, 0.6, 1.0}) {
    std::vector<char> is_wanted;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      is_wanted.push_back(std::uniform_real_distribution<double>()(random) < density ? 1 : 0);
    const CurvePiece piece = piece_of_curves(curves, is_wanted, 3);
    Positions part;
    for (const std::int32_t number : piece.number) part.push_back(nodes[static_cast<std::size_t>(number)]);
    const Forces found = forces_on(piece.curves, part);
    std::size_t wanted = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const auto number = static_cast<std::size_t>(piece.number[k]);
      EXPECT_EQ(piece.curves.nodes[k].particle, curves.nodes[number].particle);
      const bool is_beyond =
          std::find(piece.beyond.begin(), piece.beyond.end(), static_cast<std::int32_t>(k)) != piece.beyond.end();
      ASSERT_EQ(is_beyond, is_wanted[number] == 0);
      if (is_beyond) continue;
      ++wanted;
      EXPECT_EQ(found.points[k], whole.points[number]);
      EXPECT_EQ(found.conservative[k], whole.conservative[number]);
      EXPECT_EQ(found.polynomial[k], whole.polynomial[number]);
    }
    EXPECT_EQ(wanted, static_cast<std::size_t>(std::count(is_wanted.begin(), is_wanted.end(), 1)));
    // Sums over points are in the order of the curves.
    EXPECT_TRUE(std::is_sorted(piece.number.begin(), piece.number.end()));
  }
}

TEST(CurvePiece, LeavesOutWhatIsFarFromAllThatIsWanted) {
  const Positions positions = drops();
  const SurfaceCurves curves = curves_of(positions);
  std::vector<char> is_wanted(curves.nodes.size(), 0);
  const SurfaceCurves::Range hole = curves.curve(1);
  is_wanted[hole.first + 1] = 1;
  const CurvePiece piece = piece_of_curves(curves, is_wanted, 3);
  ASSERT_EQ(piece.curves.size(), 1U);
  EXPECT_EQ(piece.first_places, Positions{curves.nodes[hole.first].centre});
  EXPECT_EQ(piece.curves.nodes.size(), 7U);
  EXPECT_EQ(piece.beyond.size(), 6U);
  EXPECT_EQ(piece.number.front(), static_cast<std::int32_t>(hole.first));
  EXPECT_EQ(piece.number.back(), static_cast<std::int32_t>(hole.last) - 1);
  EXPECT_EQ(piece.curves.nodes[1].particle, curves.nodes[hole.first + 1].particle);

  const CurvePiece none = piece_of_curves(curves, std::vector<char>(curves.nodes.size(), 0), 3);
  EXPECT_EQ(none.curves.size(), 0U);
  EXPECT_TRUE(none.number.empty());
}

TEST(CurvePiece, OfAllIsAll) {
  const Positions positions = drops();
  const SurfaceCurves curves = curves_of(positions);
  const CurvePiece piece = piece_of_curves(curves, std::vector<char>(curves.nodes.size(), 1), 3);
  EXPECT_EQ(piece.curves.curve_start, curves.curve_start);
  EXPECT_EQ(piece.curves.nodes.size(), curves.nodes.size());
  EXPECT_TRUE(piece.beyond.empty());
  EXPECT_EQ(piece.first_places.size(), curves.size());
  EXPECT_EQ(piece.number.back(), static_cast<std::int32_t>(curves.nodes.size()) - 1);
}

}  // namespace
}  // namespace sphdrop
