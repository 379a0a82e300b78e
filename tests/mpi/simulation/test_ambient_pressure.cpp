// A gauge below zero: the air's pressure on the drop's surface, the same on any number of ranks.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/equal_states.hpp"

namespace sphdrop {
namespace {

using test::WholeState;

constexpr const char* pressed_drop = R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[fluid]
ambient_pressure = 150.0
gauge_relaxation_time = 5e-6
[drop]
diameter = 0.8e-3
velocity = [0.0, -2.0]
gap = 1e-6
[solid]
kind = "rigid_wall"
)";

TEST(AmbientPressure, IsTheSameOnAnyNumberOfRanks) {
  constexpr int steps = 300;
  const WholeState alone = test::expect_case_equal_on_ranks(pressed_drop, steps, 0xe08ac6c9cb8b7070ULL);
  if (alone.observations.empty()) return;  // not on rank 0
  const Observation& last = alone.observations.back();
  EXPECT_LT(last.gauge_pressure, -100.0);
  EXPECT_GE(last.gauge_pressure, -150.0);
  EXPECT_LT(std::abs(last.unaccounted), 0.01 * alone.observations.front().kinetic_fluid);
}

}  // namespace
}  // namespace sphdrop
