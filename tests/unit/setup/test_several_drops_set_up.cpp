// Several drops, ellipses, and drops at a given height, as particles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "config/case_file.hpp"
#include "setup/droplet.hpp"
#include "setup/initial_state.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

InitialState build(const std::string& drops, const std::string& solid = "") {
  return build_initial_state(
      parse_case_text("[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n" + drops + solid, "pair.cfg").values);
}

TEST(Ellipse, HasItsMassAndMoments) {
  const double a = 0.6e-3, b = 0.4e-3;
  const DropParticles drop = elliptic_drop(a, b, 1e-5, 1000).all();
  const double mass = std::accumulate(drop.masses.begin(), drop.masses.end(), 0.0);
  EXPECT_NEAR(mass, 1000 * std::numbers::pi * a * b, 1e-12);
  double xx = 0, yy = 0;
  for (std::size_t k = 0; k < drop.positions.size(); ++k) {
    xx += drop.masses[k] * drop.positions[k].x * drop.positions[k].x;
    yy += drop.masses[k] * drop.positions[k].y * drop.positions[k].y;
  }
  EXPECT_NEAR(xx / mass, a * a / 4, 0.01 * a * a / 4);
  EXPECT_NEAR(yy / mass, b * b / 4, 0.01 * b * b / 4);
}

TEST(Ellipse, KeepsTheCirclesArea) {
  const InitialState state = build("[drop]\nshape = \"ellipse\"\ndiameter = 1e-3\naspect_ratio = 2\njitter = 0\n");
  double width = 0, height = 0;
  for (const Vector p : state.fluid.positions) {
    width = std::max(width, 2 * std::abs(p.x));
    height = std::max(height, 2 * std::abs(p.y));
  }
  EXPECT_NEAR(width, 1e-3 * std::sqrt(2.0), 5e-5);
  EXPECT_NEAR(height, 1e-3 / std::sqrt(2.0), 5e-5);
  EXPECT_NEAR(std::accumulate(state.fluid.masses.begin(), state.fluid.masses.end(), 0.0),
              1000 * std::numbers::pi * 0.25e-6, 1e-12);
}

TEST(SeveralDrops, StandOneAfterTheOther) {
  const InitialState alone = build("[drop]\ndiameter = 0.5e-3\nvelocity = [1, 0]\n");
  const InitialState pair = build(
      "[[drop]]\ndiameter = 0.5e-3\nvelocity = [1, 0]\n"
      "[[drop]]\ndiameter = 0.4e-3\nvelocity = [-1, 0.5]\ncentre_x = 1e-3\ncentre_y = -2e-4\n");
  const std::size_t first = alone.fluid.positions.size();
  ASSERT_GT(pair.fluid.positions.size(), first);
  Vector centre{};
  double mass = 0;
  for (std::size_t k = 0; k < pair.fluid.positions.size(); ++k) {
    if (k < first) {
      EXPECT_EQ(pair.fluid.positions[k], alone.fluid.positions[k]);
      EXPECT_EQ(pair.fluid.velocities[k], (Vector{1, 0}));
    } else {
      EXPECT_EQ(pair.fluid.velocities[k], (Vector{-1, 0.5}));
      centre += pair.fluid.masses[k] * pair.fluid.positions[k];
      mass += pair.fluid.masses[k];
    }
  }
  EXPECT_NEAR(centre.x / mass, 1e-3, 1e-12);
  EXPECT_NEAR(centre.y / mass, -2e-4, 1e-12);
}

TEST(SeveralDrops, MustNotOverlap) {
  const std::string second = "[[drop]]\ndiameter = 1e-3\ncentre_x = ";
  EXPECT_NO_THROW(build("[[drop]]\ndiameter = 1e-3\n" + second + "1.01e-3\n"));
  try {
    build("[[drop]]\ndiameter = 1e-3\n" + second + "0.9e-3\n");
    FAIL() << "drops that overlap were set up";
  } catch (const SetupError& error) {
    EXPECT_NE(std::string(error.what()).find("the drops 1 and 2 overlap"), std::string::npos) << error.what();
  }
}

TEST(DropAtAHeight, IsThereAndNotInTheSolid) {
  const std::string wall = "[solid]\nkind = \"rigid_wall\"\n";
  EXPECT_EQ(build("[drop]\ndiameter = 1e-3\nplacement = \"centre\"\ncentre_y = 2e-3\n", wall).drop_centre.y, 2e-3);
  EXPECT_THROW(build("[drop]\ndiameter = 1e-3\nplacement = \"centre\"\ncentre_y = 0.3e-3\n", wall), SetupError);
}

}  // namespace
}  // namespace sphdrop
