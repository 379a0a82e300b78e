// Beams with damping in proportion to mass: how fast they come to rest, and where.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnostics/frequency.hpp"
#include "diagnostics/theory.hpp"
#include "tests/support/watched_run.hpp"

namespace sphdrop {
namespace {

using test::watch;
using test::WatchedRun;

WatchedRun vibrate(double damping_rate) {
  return watch(fmt::format(R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 3.2e-3
sound_cfl = 0.3
[drop]
shape = "none"
[solid]
kind = "cantilever"
length = 4e-3
artificial_stress_coefficient = 0.0
initial_tip_velocity = 0.05
damping_rate = {}
)",
                           damping_rate),
               1e-5);
}

DampedSinusoid swing(const WatchedRun& run) {
  return fit_damped_sinusoid(run.column(&Observation::time), run.column(&Observation::deflection));
}

// The amplitude decays by exp(-rate t/2) more than by the beam's own viscosity, and the frequency goes down by
// rate^2/(8 omega^2), here less than a thousandth.
TEST(DampedVibration, DecaysByHalfTheRate) {
  const double rate = 600.0;
  const WatchedRun free = vibrate(0.0), damped = vibrate(rate);
  const DampedSinusoid free_swing = swing(free), damped_swing = swing(damped);
  EXPECT_NEAR(damped_swing.decay_rate - free_swing.decay_rate, rate / 2, 0.02 * rate / 2);
  EXPECT_NEAR(damped_swing.frequency / free_swing.frequency, 1.0, 2e-3);
  EXPECT_NEAR(damped_swing.amplitude / free_swing.amplitude, 1.0, 0.01);

  // Heat takes up what the motion loses: the ledger is as closed as without damping.
  const double start = free.first().total;
  EXPECT_LT(damped.last().total, 0.8 * free.last().total);
  EXPECT_GT(damped.last().dissipated_solid, free.last().dissipated_solid + 0.2 * start);
  EXPECT_LT(std::abs(damped.last().unaccounted - free.last().unaccounted), 1e-3 * start);
}

// Turek's and Hron's beam (2006), coarse and so too soft, until it is at rest; a quarter of their gravity, so that
// slopes stay small.
TEST(DampedBeam, ComesToRestUnderItsWeight) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 5e-3
[time]
end = 3.0
sound_cfl = 0.3
[drop]
shape = "none"
[solid]
kind = "cantilever"
length = 0.35
thickness = 0.02
youngs_modulus = 1.4e6
poisson_ratio = 0.4
damping_rate = 10
[gravity]
acceleration = [0.0, -0.5]
)",
                               0.1);
  const Observation &rest = run.last(), &before = run.rows[run.rows.size() - 6];
  EXPECT_NEAR(rest.deflection / before.deflection, 1.0, 5e-4);
  EXPECT_LT(rest.kinetic_solid, 1e-8 * rest.elastic);

  // The shape, nearly, of Euler and Bernoulli's beam under an even load: mid-span sinks 17/48 as far as the end; and
  // the end draws back by 4/7 of depth^2/length, as the line through the middle keeps its length.
  EXPECT_NEAR(rest.middle_deflection / rest.deflection, 17.0 / 48.0, 0.04);
  EXPECT_NEAR(rest.tip_displacement_x / (-4.0 / 7.0 * rest.deflection * rest.deflection / 0.35), 1.0, 0.07);
  const double theory = cantilever_depth_under_weight({1.4e6, 0.4, 1000.0, 0.35, 0.02}, 0.5);
  // As soft as known: at 4 rows with eps = 0.2 the frequency is 0.80 of theory's, and 1/0.80^2 = 1.56.
  EXPECT_NEAR(-rest.deflection / theory, 1.556, 0.02);

  // What the weight gave is elastic energy and heat.
  EXPECT_GT(rest.elastic, 0.4 * -(rest.gravity - run.first().gravity));
  EXPECT_LT(std::abs(rest.unaccounted), 2e-3 * rest.elastic);
}

TEST(MiddleOfABeam, IsTheDeflectionWhereBothEndsAreHeld) {
  const WatchedRun run = watch(R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 2e-5
[drop]
shape = "none"
[solid]
kind = "fixed_fixed_beam"
length = 2e-3
[gravity]
acceleration = [0.0, -1000.0]
)",
                               1e-5);
  EXPECT_LT(run.last().deflection, 0.0);
  EXPECT_EQ(run.last().middle_deflection, run.last().deflection);
  EXPECT_TRUE(std::isnan(run.last().tip_displacement_x));
}

}  // namespace
}  // namespace sphdrop
