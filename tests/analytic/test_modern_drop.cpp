// The modern liquid against the exact theory of a viscous drop's small swing, its Laplace pressure at rest, and the
// laws of conservation.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnostics/frequency.hpp"
#include "tests/support/watched_run.hpp"

namespace sphdrop {
namespace {

using test::watch;
using test::WatchedRun;

constexpr double sigma = 0.072, radius = 5e-4;

/// 176 particles; `fluid` and `drop` are lines of these sections.
WatchedRun run_drop(double end, const std::string& fluid, const std::string& drop, const std::string& rest = {}) {
  return watch(fmt::format(R"(
[resolution]
spacing = 0.0714e-3
[time]
end = {}
sound_cfl = 0.2
capillary_cfl = 0.2
[fluid]
viscosity_form = "physical"
{}
[drop]
{}
{})",
                           end, fluid, drop, rest),
               2e-5);
}

double largest(const WatchedRun& run, double Observation::*member) {
  double found = 0;
  for (const Observation& row : run.rows) found = std::max(found, std::abs(row.*member));
  return found;
}

// Root of the linear free-surface flow's characteristic equation (cases/oscillating_droplet/plot.py) for mu = 0.01:
// decay 141.28 1/s, period 3.4155 ms. At this spacing the period is some 3 % long, at d = 0.025 mm 0.7 %.
TEST(ModernDrop, SwingsAndDecaysAsTheoryOfAViscousDropSays) {
  for (const std::string density :
       {"density_treatment = \"moving_least_squares\"", "density_treatment = \"density_diffusion\""}) {
    const WatchedRun run = run_drop(6e-3, "viscosity = 0.01\ngauge_pressure = \"on\"\n" + density,
                                    "relaxation_time = 0.5e-3\noscillation_velocity = 0.05");
    const DampedSinusoid swing =
        fit_damped_sinusoid(run.column(&Observation::time), run.column(&Observation::drop_elongation));
    EXPECT_NEAR(swing.decay_rate / 141.28, 1.0, 0.1) << density;
    EXPECT_NEAR(1 / swing.frequency / 3.4155e-3, 1.03, 0.02) << density;
    EXPECT_EQ(run.first().time, 0.0);
    EXPECT_GT(run.first().kinetic_fluid, 0.0);
    EXPECT_LT(largest(run, &Observation::unaccounted), 1e-3 * run.first().kinetic_fluid) << density;
  }
}

TEST(ModernDrop, AtRestHasTheLaplacePressure) {
  const WatchedRun run =
      run_drop(1.5e-3, "viscosity = 0.01\ngauge_pressure = \"on\"\nshifting = \"on\"", "relaxation_time = 0.5e-3");
  EXPECT_NEAR(run.mean_from(1e-3, &Observation::mean_pressure), sigma / radius, 0.01 * sigma / radius);
  // Nearly all of it is gauge.
  EXPECT_GT(run.mean_from(1e-3, &Observation::gauge_pressure), 0.8 * sigma / radius);
  EXPECT_LT(run.last().gauge_pressure, run.last().mean_pressure);
}

TEST(ModernDrop, KeepsMomentumWithEverythingOn) {
  const WatchedRun run = run_drop(1e-3, "viscosity = 0.002\ngauge_pressure = \"on\"\nshifting = \"on\"",
                                  "oscillation_velocity = 0.8\nvelocity = [0.7, 0.3]");
  const Observation& first = run.first();
  const double momentum = std::hypot(first.momentum_fluid_x, first.momentum_fluid_y);
  for (const Observation& row : run.rows) {
    EXPECT_NEAR(row.momentum_fluid_x, first.momentum_fluid_x, 1e-12 * momentum) << row.time;
    EXPECT_NEAR(row.momentum_fluid_y, first.momentum_fluid_y, 1e-12 * momentum) << row.time;
  }
  EXPECT_NE(run.last().shifting_work, 0.0);
  EXPECT_GT(run.last().gauge_pressure, 0.0);
}

// Shifts neither work on the contact's springs, which gave a tenth of the energy, nor let the drop swell.
TEST(ModernDrop, KeepsItsEnergyAndAreaInAnImpact) {
  const WatchedRun run = watch(R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 2e-3
[drop]
velocity = [0.0, -1.0]
[solid]
kind = "rigid_wall"
)",
                               2e-5);
  EXPECT_LT(largest(run, &Observation::unaccounted), 0.01 * run.first().kinetic_fluid);
  for (const Observation& row : run.rows) EXPECT_NEAR(row.curve_area / run.first().curve_area, 1.0, 0.15) << row.time;
  EXPECT_GT(run.last().drop_width, 2e-3);
}

// The film that draws back is under tension; without the air's pressure it tears inside and the drop swells.
TEST(ModernDrop, StaysWholeUnderTheAirsPressure) {
  double largest_area[2] = {0, 0};
  for (const int is_pressed : {0, 1}) {
    const WatchedRun run = watch(fmt::format(R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 3e-3
[fluid]
ambient_pressure = {}
[drop]
velocity = [0.0, -1.0]
[solid]
kind = "rigid_wall"
)",
                                             150.0 * is_pressed),
                                 2e-5);
    double lowest_gauge = 0;
    for (const Observation& row : run.rows) {
      largest_area[is_pressed] = std::max(largest_area[is_pressed], row.curve_area / run.first().curve_area);
      lowest_gauge = std::min(lowest_gauge, row.gauge_pressure);
    }
    EXPECT_GE(lowest_gauge, -150.0 * is_pressed);
    EXPECT_LT(largest(run, &Observation::unaccounted), 0.01 * run.first().kinetic_fluid);
  }
  EXPECT_GT(largest_area[0], 1.08);
  EXPECT_LT(largest_area[1], 1.02);
}

// Every cause but the steps' length has its column: with steps half as long a quarter is left.
TEST(ModernDrop, LeavesUnaccountedWhatTheStepsLengthMakes) {
  const auto unaccounted_with = [](double sound_cfl) {
    const WatchedRun run = watch(fmt::format(R"(
mode = "modern"
[resolution]
spacing = 0.1e-3
[time]
end = 2e-3
sound_cfl = {}
[drop]
velocity = [0.0, -1.0]
[solid]
kind = "rigid_wall"
)",
                                             sound_cfl),
                                 2e-5);
    EXPECT_GT(largest(run, &Observation::density_correction), 0.1 * run.first().kinetic_fluid);
    EXPECT_GT(largest(run, &Observation::sharing_work), 0.002 * run.first().kinetic_fluid);
    return largest(run, &Observation::unaccounted) / run.first().kinetic_fluid;
  };
  const double whole = unaccounted_with(0.2), half = unaccounted_with(0.1);
  EXPECT_LT(whole, 0.01);
  EXPECT_LT(half, 0.4 * whole);
}

// Before its start the drop hangs still at its place, without weight; then it falls.
TEST(ModernDrop, StartsAtRestFromItsPlaceAndFallsThen) {
  const WatchedRun run =
      run_drop(0.5e-3, "gauge_pressure = \"on\"", "relaxation_time = 0.3e-3\nvelocity = [0.0, -0.25]",
               "[gravity]\nacceleration = [0.0, -100.0]");
  EXPECT_EQ(run.first().time, 0.0);
  EXPECT_NEAR(run.first().drop_centre_y, 0.0, 1e-12);
  EXPECT_NEAR(run.first().drop_velocity_y, -0.25, 1e-12);
  EXPECT_EQ(run.first().dissipated_fluid, 0.0);
  const double t = run.last().time;
  EXPECT_NEAR(run.last().drop_centre_y, -0.25 * t - 50 * t * t, 1e-9);
}

}  // namespace
}  // namespace sphdrop
