// A rigid drop against what rigid bodies are known to do: free flight, elastic impact, and the balance of momentum,
// angular momentum and energy.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/support/watched_run.hpp"

namespace sphdrop {
namespace {

using test::watch;
using test::WatchedRun;

// The largest relative change of any particle's distance from particle 0, over all steps.
class ShapeKeeper {
 public:
  void operator()(const Simulation& simulation) {
    const FluidParticles& drop = simulation.fluid();
    std::vector<Vector> positions(drop.owned_count());
    drop.for_each_owned(
        [&](std::size_t row) { positions[static_cast<std::size_t>(drop.id[row])] = drop.position.at(row); });
    std::vector<double> distances;
    for (std::size_t k = 1; k < positions.size(); ++k) distances.push_back(length(positions[k] - positions[0]));
    if (first_.empty()) first_ = distances;
    for (std::size_t k = 0; k < distances.size(); ++k)
      largest_change_ = std::max(largest_change_, std::abs(distances[k] / first_[k] - 1.0));
  }
  double largest_change() const { return largest_change_; }

 private:
  std::vector<double> first_;
  double largest_change_ = 0;
};

// What contact gives the solid, the body loses: momentum and angular momentum about the origin.
void expect_balances(const WatchedRun& run) {
  const Observation& first = run.first();
  const double momentum = std::hypot(first.momentum_fluid_x, first.momentum_fluid_y);
  for (const Observation& row : run.rows) {
    EXPECT_NEAR(row.momentum_fluid_x + row.contact_impulse_x, first.momentum_fluid_x, 1e-11 * momentum) << row.time;
    EXPECT_NEAR(row.momentum_fluid_y + row.contact_impulse_y, first.momentum_fluid_y, 1e-11 * momentum) << row.time;
    // Until contact is over, the values predicted for an instant are good to the second order of the step.
    const double share = &row == &run.last() ? 1e-11 : 1e-4;
    EXPECT_NEAR(row.angular_momentum_fluid + row.contact_angular_impulse, first.angular_momentum_fluid,
                share * momentum * 1e-3)
        << row.time;
  }
  EXPECT_EQ(run.last().contact_count, 0.0);
}

TEST(RigidBall, FliesOnAParabolaAndTurnsAtConstantSpin) {
  const Vector v{0.3, -0.4}, g{2.0, -9.81};
  const double spin = -4000.0;
  ShapeKeeper shape;
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.05e-3
[time]
end = 2e-3
[drop]
material = "rigid"
density = 2000.0
velocity = [0.3, -0.4]
initial_spin = -4000.0
[gravity]
acceleration = [2.0, -9.81]
)",
                               2e-4, std::ref(shape));
  const double mass = 2000.0 * std::numbers::pi * 0.25e-6;
  const double inertia = 0.5 * mass * 0.25e-6 * (1.0 - 0.5 / 100.0);  // of ten rings
  const Observation& first = run.first();
  ASSERT_GT(run.rows.size(), 8u);
  for (const Observation& row : run.rows) {
    const double t = row.time;
    EXPECT_NEAR(row.drop_centre_x, first.drop_centre_x + v.x * t + 0.5 * g.x * t * t, 1e-14);
    EXPECT_NEAR(row.drop_centre_y, first.drop_centre_y + v.y * t + 0.5 * g.y * t * t, 1e-14);
    EXPECT_NEAR(row.drop_velocity_x, v.x + g.x * t, 1e-12);
    EXPECT_NEAR(row.drop_velocity_y, v.y + g.y * t, 1e-12);
    EXPECT_EQ(row.drop_spin, spin);
    EXPECT_NEAR(row.drop_angle, spin * t, 1e-10);
    // Summed from the particles, so the rotation's part must be in it.
    const double speed_squared = squared_length({row.drop_velocity_x, row.drop_velocity_y});
    EXPECT_NEAR(row.kinetic_fluid / (0.5 * mass * speed_squared + 0.5 * inertia * spin * spin), 1.0, 1e-12);
    EXPECT_NEAR(row.total, first.total, 1e-10 * first.kinetic_fluid);
  }
  EXPECT_LT(shape.largest_change(), 1e-12);
}

TEST(RigidBall, HasNothingOfALiquid) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.05e-3
[time]
end = 2e-5
[drop]
material = "rigid"
density = 700.0
)",
                               1e-5);
  const Observation& row = run.last();
  for (const double absent : {row.mean_pressure, row.curve_length, row.mean_curvature, row.tension_net_force})
    EXPECT_TRUE(std::isnan(absent));
  for (const double none : {row.surface, row.compressive, row.dissipated_fluid, row.density_correction,
                            row.largest_density_error, row.kinetic_fluid})
    EXPECT_EQ(none, 0.0);
}

// Elastic springs, no friction: all of the speed comes back. A ball of rings is not quite even, so that a little of it
// comes back as spin; the energy tells. The springs are as stiff as the step is short (Eq 24), so it must not change.
TEST(RigidBall, ReboundsFromARigidWallWithItsSpeed) {
  ShapeKeeper shape;
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-4
step = 5e-8
[drop]
material = "rigid"
velocity = [0.3, -0.5]
initial_spin = 200.0
[solid]
kind = "rigid_wall"
)",
                               1e-6, std::ref(shape));
  EXPECT_EQ(run.last().contact_count, 0.0);
  EXPECT_NEAR(run.last().drop_velocity_y, 0.5, 0.01);
  EXPECT_NEAR(run.last().drop_velocity_x, 0.3, 1e-12);  // no friction
  EXPECT_NEAR(run.last().kinetic_fluid / run.first().kinetic_fluid, 1.0, 1e-4);
  expect_balances(run);
  EXPECT_LT(shape.largest_change(), 1e-12);
}

// The same with springs that do not depend on the step: half the step changes nothing, and dampers take energy that is
// accounted for.
TEST(RigidBall, OnFixedSpringsReboundsAlikeAtAnyStepAndLosesWhatDampersTake) {
  const auto impact = [](double step, double damping_ratio) {
    return watch(fmt::format(R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1.5e-4
step = {}
[drop]
material = "rigid"
velocity = [0.3, -0.5]
[solid]
kind = "rigid_wall"
[contact]
stiffness_form = "fixed"
stiffness = 20.0
damping_ratio = {}
)",
                             step, damping_ratio),
                 1e-6);
  };
  const WatchedRun elastic = impact(5e-8, 0.0), finer = impact(2.5e-8, 0.0), damped = impact(5e-8, 0.2);
  const double start = elastic.first().kinetic_fluid;
  double stored = 0, force = 0, force_at_finer = 0;
  for (const Observation& row : elastic.rows) {
    stored = std::max(stored, row.contact);
    force = std::max(force, -row.contact_force_y);
    EXPECT_LT(std::abs(row.unaccounted), 2e-3 * start) << row.time;
  }
  for (const Observation& row : finer.rows) force_at_finer = std::max(force_at_finer, -row.contact_force_y);
  EXPECT_GT(stored, 0.5 * start);
  EXPECT_NEAR(force_at_finer / force, 1.0, 0.02);  // Eq 24's would double
  EXPECT_NEAR(elastic.last().drop_velocity_y / finer.last().drop_velocity_y, 1.0, 1e-3);
  EXPECT_NEAR(elastic.last().kinetic_fluid / start, 1.0, 1e-4);
  EXPECT_EQ(elastic.last().dissipated_contact, 0.0);
  expect_balances(elastic);

  EXPECT_LT(damped.last().kinetic_fluid, 0.98 * start);
  EXPECT_NEAR(damped.last().kinetic_fluid + damped.last().dissipated_contact, start, 2e-3 * start);
  for (const Observation& row : damped.rows) EXPECT_LT(std::abs(row.unaccounted), 4e-3 * start) << row.time;
  expect_balances(damped);
}

// A square that overhangs the end of a wall, so that but its outermost column of particles is above it.
WatchedRun corner_impact(int side) {
  constexpr double d = 0.05e-3, half_wall = 1e-3;
  // The outermost column stands a quarter of a spacing inside the wall's last particle.
  const double centre = side * (half_wall - 0.5 * d - 0.25 * d + 0.5 * 0.5e-3 - 0.5 * d);
  return watch(fmt::format(R"(
[resolution]
spacing = {}
[time]
end = 1e-4
step = 5e-8
[drop]
material = "rigid"
shape = "square"
diameter = 0.5e-3
velocity = [0.0, -0.5]
centre_x = {}
[solid]
kind = "rigid_wall"
length = {}
)",
                           d, centre, 2.0 * half_wall),
               1e-6);
}

// One particle at the arm b strikes: the impulse J = 2 M U/(1 + M b^2/I) upwards at the arm -+b gives v' = -U + J/M and
// the spin -+J b/I.
TEST(RigidSquare, OverTheEdgeOfAWallTurnsAsAnElasticImpactAtItsCornerSays) {
  constexpr double U = 0.5, a = 0.5e-3, d = 0.05e-3, b = 0.5 * (a - d);
  const double mass = 1000.0 * a * a, inertia = mass * a * a / 6.0 * (1.0 - d * d / (a * a));
  const double impulse = 2.0 * mass * U / (1.0 + mass * b * b / inertia);
  for (const int side : {1, -1}) {
    const WatchedRun run = corner_impact(side);
    const Observation& last = run.last();
    EXPECT_EQ(last.contact_count, 0.0);
    EXPECT_NEAR(-last.contact_impulse_y / impulse, 1.0, 0.01) << side;
    EXPECT_NEAR(last.drop_velocity_y, -U + impulse / mass, 0.01 * U) << side;
    // The wall lies on the left for side 1: struck there upwards, the square turns clockwise.
    EXPECT_NEAR(last.drop_spin * side / (-impulse * b / inertia), 1.0, 0.01) << side;
    EXPECT_NEAR(last.kinetic_fluid / run.first().kinetic_fluid, 1.0, 1e-3) << side;
    expect_balances(run);
  }
}

TEST(RigidBall, GivesACantileverWhatItLoses) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 0.3e-3
sound_cfl = 0.3
[drop]
material = "rigid"
diameter = 0.6e-3
velocity = [0.0, -0.8]
[solid]
kind = "cantilever"
length = 2e-3
)",
                               1e-6);
  EXPECT_LT(run.last().contact_impulse_y, 0.0);
  double lowest = 0;
  for (const Observation& row : run.rows) lowest = std::min(lowest, row.deflection);
  EXPECT_LT(lowest, -10e-6);  // Eq 46: 18
  expect_balances(run);
  // The springs' energy is the contact's own; what the beam takes up or turns into heat is told by its columns.
  for (const Observation& row : run.rows)
    EXPECT_LT(std::abs(row.unaccounted), 0.02 * run.first().kinetic_fluid) << row.time;
  EXPECT_GT(run.last().kinetic_solid + run.last().elastic, 0.0);
}

}  // namespace
}  // namespace sphdrop
