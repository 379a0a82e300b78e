#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "setup/initial_state.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

constexpr double d = 0.025e-3;

Case impact_case(SolidKind kind) {
  Case input;
  input.resolution.spacing = d;
  input.fluid.density = 1000;
  input.drop.shape = DropShape::round;
  input.drop.diameter = 1e-3;
  input.drop.velocity_y = -0.8;
  input.drop.gap = 0.1 * d;
  input.drop.centre_x = std::numeric_limits<double>::quiet_NaN();
  input.drop.jitter = 0.01;
  input.drop.seed = 1;
  input.solid.kind = kind;
  input.solid.length = 4e-3;
  input.solid.thickness = 0.25e-3;
  input.solid.density = 1000;
  input.solid.clamp_length = 0.5e-3;
  input.solid.clamp_layers = 3;
  input.contact.distance_ratio = 1.0;
  return input;
}

double lowest(const InitialFluid& fluid) {
  return std::min_element(fluid.positions.begin(), fluid.positions.end(), [](Vector a, Vector b) { return a.y < b.y; })
      ->y;
}

std::string message_of(const Case& input) {
  try {
    build_initial_state(input);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

/// FNV-1a over the bits, written out here so that the numbers below mean the same everywhere.
std::uint64_t hash_of(const std::vector<Vector>& vectors) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Vector& v : vectors) {
    for (const double component : {v.x, v.y}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(component)) * 0x100000001b3u;
    }
  }
  return hash;
}

TEST(InitialState, PlacesTheDropWhereTheSolidSays) {
  EXPECT_DOUBLE_EQ(build_initial_state(impact_case(SolidKind::cantilever)).drop_centre.x, 3.5e-3);
  EXPECT_DOUBLE_EQ(build_initial_state(impact_case(SolidKind::fixed_fixed_beam)).drop_centre.x, 2e-3);
  EXPECT_EQ(build_initial_state(impact_case(SolidKind::rigid_wall)).drop_centre.x, 0.0);
  EXPECT_EQ(build_initial_state(impact_case(SolidKind::none)).drop_centre, Vector{});
  Case input = impact_case(SolidKind::cantilever);
  input.drop.centre_x = 2.7e-3;
  EXPECT_EQ(build_initial_state(input).drop_centre.x, 2.7e-3);
}

TEST(InitialState, LeavesTheGapUnderEveryKindOfDrop) {
  for (const SolidKind kind : {SolidKind::cantilever, SolidKind::fixed_fixed_beam, SolidKind::rigid_wall}) {
    const double surface = kind == SolidKind::rigid_wall ? 0.0 : 0.25e-3;
    for (const double gap : {0.0, 0.1 * d, 0.3e-3}) {
      for (int variant = 0; variant < 3; ++variant) {
        Case input = impact_case(kind);
        input.drop.gap = gap;
        input.drop.shape = variant == 2 ? DropShape::square : DropShape::round;
        input.drop.arrangement = variant == 0 ? DropArrangement::rings : DropArrangement::lattice;
        const InitialState state = build_initial_state(input);
        EXPECT_NEAR(lowest(state.fluid), surface + gap + 0.5 * d, 1e-9 * d);
        EXPECT_NEAR(state.drop_centre.y, surface + gap + 0.5e-3, 0.6 * d);
      }
    }
  }
}

TEST(InitialState, MovesEveryParticleOfTheDropAlike) {
  const InitialState state = build_initial_state(impact_case(SolidKind::cantilever));
  EXPECT_EQ(state.fluid.velocities.size(), state.fluid.positions.size());
  EXPECT_EQ(state.fluid.masses.size(), state.fluid.positions.size());
  for (const Vector& velocity : state.fluid.velocities) EXPECT_EQ(velocity, (Vector{0, -0.8}));
}

TEST(InitialState, AddsTheOscillationAboutTheDropsCentre) {
  Case input = impact_case(SolidKind::rigid_wall);
  input.drop.oscillation_velocity = 0.8;
  input.drop.oscillation_radius = 0.25e-3;
  input.drop.centre_x = 0.2e-3;
  const InitialState state = build_initial_state(input);
  double largest = 0;
  for (std::size_t i = 0; i < state.fluid.positions.size(); ++i) {
    const Vector x = state.fluid.positions[i] - state.drop_centre;
    const double r = length(x), r0 = 0.25e-3;
    EXPECT_NEAR(state.fluid.velocities[i].x, 0.8 * x.x / r0 * (1 - x.y * x.y / (r0 * r)) * std::exp(-r / r0), 1e-10);
    EXPECT_NEAR(state.fluid.velocities[i].y, -0.8 - 0.8 * x.y / r0 * (1 - x.x * x.x / (r0 * r)) * std::exp(-r / r0),
                1e-10);
    largest = std::max(largest, state.fluid.velocities[i].x);
  }
  EXPECT_NEAR(largest, 0.8 * std::exp(-1), 0.01);  // on the x axis at r0
  input.drop.oscillation_radius = 0;
  EXPECT_THROW(build_initial_state(input), SetupError);
}

TEST(InitialState, RefusesADropInsideTheContactDistance) {
  Case input = impact_case(SolidKind::cantilever);
  input.drop.gap = 0;
  EXPECT_EQ(message_of(input), "");
  input.contact.distance_ratio = 1.2;  // the boundary row is d below the lowest particle
  const std::string message = message_of(input);
  EXPECT_NE(message.find("the drop overlaps the solid at the start"), std::string::npos) << message;
  EXPECT_NE(message.find("by 5e-06 m"), std::string::npos) << message;
  EXPECT_NE(message.find("drop.gap"), std::string::npos) << message;
  input.drop.gap = 0.2 * d;
  EXPECT_EQ(message_of(input), "");
}

TEST(InitialState, RefusesADropInTheClamp) {
  // The strips stand three layers above the beam's surface.
  Case input = impact_case(SolidKind::cantilever);
  for (const double x : {-0.5e-3, -0.2e-3, 0.05e-3}) {
    input.drop.centre_x = x;
    EXPECT_NE(message_of(input).find("overlaps the solid"), std::string::npos) << x;
  }
  // A drop of three particles, wholly inside a strip.
  input.drop.diameter = 2 * d;
  input.drop.centre_x = -0.25e-3;
  input.solid.clamp_layers = 12;
  input.drop.gap = 5 * d;
  EXPECT_NE(message_of(input).find("overlaps the solid"), std::string::npos);
  input.drop.gap = 12 * d;
  EXPECT_EQ(message_of(input), "");
}

TEST(InitialState, AllowsFreeFlightBesideTheSolid) {
  Case input = impact_case(SolidKind::cantilever);
  input.drop.centre_x = 6e-3;
  EXPECT_EQ(message_of(input), "");
}

TEST(InitialState, WithoutADropHasTheSolidAlone) {
  Case input = impact_case(SolidKind::cantilever);
  input.drop.shape = DropShape::none;
  const InitialState state = build_initial_state(input);
  EXPECT_TRUE(state.fluid.positions.empty());
  EXPECT_TRUE(std::isnan(state.drop_centre.x));
  EXPECT_EQ(state.solid.positions.size(), 160u * 10 + 20u * 16);
}

TEST(InitialState, JittersALatticeByItsSeed) {
  Case input = impact_case(SolidKind::none);
  input.drop.arrangement = DropArrangement::lattice;
  const auto positions = [&](double jitter, std::int64_t seed) {
    input.drop.jitter = jitter;
    input.drop.seed = seed;
    return build_initial_state(input).fluid.positions;
  };
  const auto still = positions(0, 1);
  const auto first = positions(0.01, 1);
  EXPECT_EQ(first, positions(0.01, 1));
  EXPECT_NE(first, positions(0.01, 2));
  EXPECT_EQ(still, positions(0, 2));
  double largest = 0;
  for (std::size_t i = 0; i < still.size(); ++i)
    largest = std::max({largest, std::abs(first[i].x - still[i].x), std::abs(first[i].y - still[i].y)});
  EXPECT_LE(largest, 0.01001 * d);
  EXPECT_GT(largest, 0.0095 * d);
}

TEST(InitialState, RefusesAnAbsurdSpacing) {
  Case input = impact_case(SolidKind::cantilever);
  input.resolution.spacing = 0.25e-9;
  EXPECT_NE(message_of(input).find("choose a larger spacing"), std::string::npos);
}

TEST(InitialState, HasTheSameBitsEverywhere) {
  Case input = impact_case(SolidKind::cantilever);
  input.drop.oscillation_velocity = 0.8;
  input.drop.oscillation_radius = 0.25e-3;
  input.solid.initial_tip_velocity = 0.1;
  const InitialState state = build_initial_state(input);
  const InitialState again = build_initial_state(input);
  EXPECT_EQ(hash_of(state.fluid.positions), hash_of(again.fluid.positions));
  EXPECT_EQ(hash_of(state.solid.positions), hash_of(again.solid.positions));
  // Recorded from one build; another compiler or instruction set must not change them.
  EXPECT_EQ(hash_of(state.fluid.positions), 687551507832477317u);
  EXPECT_EQ(hash_of(state.fluid.velocities), 5964612364316541361u);
  EXPECT_EQ(hash_of(state.solid.positions), 9736922267760661529u);
  EXPECT_EQ(hash_of(state.solid.velocities), 11895427371132521061u);
}

// Its own density, an even surface, and the velocity of a turning body about the mass centre.
TEST(RigidDrop, StartsAsABodyThatTurns) {
  Case input = impact_case(SolidKind::none);
  input.drop.shape = DropShape::square;
  input.drop.material = DropMaterial::rigid;
  input.drop.density = 2500;
  input.drop.initial_spin = 300;
  const InitialFluid ball = build_initial_state(input).fluid;
  double mass = 0;
  for (const double m : ball.masses) mass += m;
  EXPECT_NEAR(mass / (2500 * 1e-6), 1, 1e-12);
  for (std::size_t k = 0; k < ball.positions.size(); ++k) {
    const Vector x = ball.positions[k] / d + Vector{0.5, 0.5};
    EXPECT_NEAR(x.x, std::round(x.x), 1e-9);
    EXPECT_NEAR(x.y, std::round(x.y), 1e-9);
    EXPECT_NEAR(ball.velocities[k].x, -300 * ball.positions[k].y, 1e-12);
    EXPECT_NEAR(ball.velocities[k].y, -0.8 + 300 * ball.positions[k].x, 1e-12);
  }
  input.drop.material = DropMaterial::liquid;
  EXPECT_EQ(build_initial_state(input).fluid.velocities[0], (Vector{0, -0.8}));
}

}  // namespace
}  // namespace sphdrop
