#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "time_integration/time_step.hpp"

namespace sphdrop {
namespace {

/// Water at the paper's resolution against its stiff beam: d = 0.025 mm, h = 1.2 d.
constexpr TimeStepLimits paper{
    .smoothing_length = 3e-5, .sound_speed = 500, .density = 1000, .surface_tension = 0.072, .viscosity = 0.001};

TEST(TimeStep, HasThePapersNumbers) {
  EXPECT_NEAR(acoustic_time_step(paper, 0.0), 6e-9, 1e-22);  // (40)
  // The paper ran at 5 ns, which the limit allows.
  EXPECT_LT(5e-9, stable_time_step(paper, 1.0));
  EXPECT_NEAR(capillary_time_step(paper), 7.7255e-7, 1e-11);  // (41)
  EXPECT_NEAR(viscous_time_step(paper), 9e-5, 1e-18);         // (42)

  TimeStepLimits soft = paper;
  soft.sound_speed = std::sqrt(5000.0);
  EXPECT_NEAR(acoustic_time_step(soft, 1.0), 3e-6 / 71.7107, 1e-13);
  EXPECT_LT(30e-9, stable_time_step(soft, 1.0));  // the paper's choice for the soft beam
}

TEST(TimeStep, HasTheValuesWorkedOutByHand) {
  constexpr TimeStepLimits l{.sound_cfl = 0.5,
                             .capillary_cfl = 0.25,
                             .viscous_cfl = 0.125,
                             .smoothing_length = 2,
                             .sound_speed = 3,
                             .density = 5,
                             .surface_tension = 0.7,
                             .viscosity = 1.6};
  EXPECT_DOUBLE_EQ(acoustic_time_step(l, 1.0), 0.25);
  EXPECT_NEAR(capillary_time_step(l), 0.25 * std::sqrt(40 / (1.4 * std::numbers::pi)), 1e-15);
  EXPECT_NEAR(viscous_time_step(l), 1.5625, 1e-15);
}

TEST(TimeStep, IsTheSmallestOfTheThree) {
  TimeStepLimits l = paper;
  EXPECT_EQ(stable_time_step(l, 2.0), acoustic_time_step(l, 2.0));
  l.surface_tension = 1e6;
  EXPECT_EQ(stable_time_step(l, 2.0), capillary_time_step(l));
  l.viscosity = 1e3;
  EXPECT_EQ(stable_time_step(l, 2.0), viscous_time_step(l));
}

TEST(TimeStep, IsThatOfSolidOrLiquidWhereTheSolidTakesSubsteps) {
  TimeStepLimits l = paper;  // 6 ns of the solid
  l.solid_substeps = 3;
  l.liquid_sound_cfl = 0.25;
  l.liquid_sound_speed = 50;
  EXPECT_NEAR(stable_time_step(l, 0.0), 18e-9, 1e-21);
  l.solid_substeps = 40;
  EXPECT_NEAR(stable_time_step(l, 0.0), 0.25 * 3e-5 / 50, 1e-21);
  EXPECT_NEAR(stable_time_step(l, 25.0), 0.25 * 3e-5 / 75, 1e-21);
}

TEST(TimeStep, ShrinksAsParticlesSpeedUp) {
  EXPECT_NEAR(acoustic_time_step(paper, 500.0), 3e-9, 1e-22);
  EXPECT_LT(acoustic_time_step(paper, 1.0), acoustic_time_step(paper, 0.0));
}

// Half of viscous_time omega is the fastest mode's damping ratio; omega = 4 c/h.
TEST(TimeStep, ShrinksAsTheSolidIsDamped) {
  TimeStepLimits l = paper;
  const double omega = 4.0 * l.sound_speed / l.smoothing_length;
  l.viscous_time = 1e-3 / omega;
  EXPECT_NEAR(acoustic_time_step(l, 0.0) / acoustic_time_step(paper, 0.0), 1.0 - 1e-3, 1e-6);
  l.viscous_time = 1e3 / omega;
  EXPECT_NEAR(acoustic_time_step(l, 0.0) / acoustic_time_step(paper, 0.0), 0.5e-3, 1e-9);
}

TEST(TimeStep, WithoutTensionOrViscosityTheirLimitsFall) {
  TimeStepLimits l = paper;
  l.surface_tension = 0;
  l.viscosity = 0;
  EXPECT_EQ(capillary_time_step(l), std::numeric_limits<double>::infinity());
  EXPECT_EQ(viscous_time_step(l), std::numeric_limits<double>::infinity());
  EXPECT_EQ(stable_time_step(l, 1.0), acoustic_time_step(l, 1.0));
}

}  // namespace
}  // namespace sphdrop
