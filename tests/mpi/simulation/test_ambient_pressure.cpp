// A gauge below zero: the air's pressure on the drop's surface, the same on any number of ranks.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/equal_states.hpp"

namespace sphdrop {
namespace {

using test::run_steps;
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
  const Communicator world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  constexpr int steps = 300;
  const WholeState together = run_steps(world, pressed_drop, steps);
  const WholeState restless = run_steps(world, pressed_drop, steps, {"parallel.repartition_interval=37"});
  if (world.rank() != 0) return;
  const WholeState alone = run_steps(self, pressed_drop, steps);
  EXPECT_EQ(alone.hash, 0xe08ac6c9cb8b7070ULL) << fmt::format("it is now 0x{:016x}", alone.hash);
  const Observation& last = alone.observations.back();
  EXPECT_LT(last.gauge_pressure, -100.0);
  EXPECT_GE(last.gauge_pressure, -150.0);
  EXPECT_LT(std::abs(last.unaccounted), 0.01 * alone.observations.front().kinetic_fluid);
  test::expect_equal(alone, together, "together");
  test::expect_equal(alone, restless, "with forced repartitions");
}

}  // namespace
}  // namespace sphdrop
