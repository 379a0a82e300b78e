// Impacts: on a rigid wall at the paper's resolution, and on the cantilever at a coarser one.

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnostics/extremes.hpp"
#include "tests/support/watched_run.hpp"

namespace sphdrop {
namespace {

using test::watch;
using test::WatchedRun;

Extremes extremes_of(const WatchedRun& run) {
  Extremes extremes;
  for (const Observation& row : run.rows)
    extremes.add(row.time, row.drop_width, std::isfinite(row.deflection) ? row.deflection : 0.0,
                 static_cast<std::int64_t>(row.contact_count), row.drop_velocity_y);
  return extremes;
}

// What contact gives the solid, the drop loses.
void expect_momentum_balance(const WatchedRun& run, double relative) {
  const double start = std::abs(run.first().momentum_fluid_y);
  EXPECT_NEAR(run.last().momentum_fluid_y - run.first().momentum_fluid_y + run.last().contact_impulse_y, 0.0,
              relative * start);
  EXPECT_NEAR(run.last().momentum_fluid_x - run.first().momentum_fluid_x + run.last().contact_impulse_x, 0.0,
              relative * start);
}

// Three things may give energy, and have their own column: the density correction, the artificial stress, and curves
// that are detected anew. What remains only falls, but for a thousandth of the drop's kinetic energy.
void expect_energy_never_rises(const WatchedRun& run) {
  const double kinetic = run.first().kinetic_fluid;
  double lowest = run.first().total;
  for (const Observation& row : run.rows) {
    const double energy = row.total - row.density_correction - row.artificial_stress_work - row.reconnection;
    EXPECT_LT(energy, lowest + 0.001 * kinetic) << "at " << row.time;
    lowest = std::min(lowest, energy);
    EXPECT_LT(std::abs(row.unaccounted), 0.025 * kinetic) << "at " << row.time;
  }
}

// The prototype of the method: 3.47 ms, 1.64, 0.56.
TEST(RigidWall, SlowImpactAtThePapersResolution) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.025e-3
[time]
end = 4.2e-3
[drop]
velocity = [0.0, -0.5]
[solid]
kind = "rigid_wall"
)",
                               1e-5);
  const Extremes extremes = extremes_of(run);
  const double contact_time = *run.contact.last_contact() - *run.contact.first_contact();
  EXPECT_NEAR(contact_time, 3.47e-3, 0.05 * 3.47e-3);
  EXPECT_NEAR(extremes.width().sampled()->value / 1e-3, 1.64, 0.05 * 1.64);
  ASSERT_TRUE(extremes.restitution().has_value());
  EXPECT_NEAR(*extremes.restitution(), 0.56, 0.05 * 0.56);
  expect_momentum_balance(run, 1e-10);
  expect_energy_never_rises(run);
  EXPECT_EQ(run.last().curve_count, 1.0);
}

// Six rows across the beam; our own value at this resolution, and what does not depend on it.
TEST(Cantilever, BendsUnderTheDrop) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 4.166666666666667e-5
[time]
end = 2.2e-3
sound_cfl = 0.2
[drop]
velocity = [0.0, -0.8]
[solid]
kind = "cantilever"
length = 8e-3
)",
                               1e-5);
  const Extremes extremes = extremes_of(run);
  EXPECT_NEAR(extremes.width().sampled()->value / 1e-3, 1.77, 0.1);
  EXPECT_NEAR(extremes.depth().sampled()->value, 0.36e-3, 0.03e-3);
  EXPECT_NEAR(extremes.depth().sampled()->time, 1.65e-3, 0.15e-3);
  expect_momentum_balance(run, 1e-9);
  expect_energy_never_rises(run);
}

}  // namespace
}  // namespace sphdrop
