#include "diagnostics/impact_estimates.hpp"

#include <gtest/gtest.h>

#include "diagnostics/theory.hpp"

namespace sphdrop {
namespace {

constexpr double density = 1000, diameter = 1e-3, tension = 0.072;

TEST(ImpactEstimates, AreNearTheRunsOfTheRigidWall) {
  // cases/COMPARISON.md: speed in m/s, D_max/D0, contact time in ms.
  const struct {
    double speed, spread, contact_time;
  } runs[] = {{0.5, 1.6379, 3.468}, {0.6, 1.7841, 3.626}, {0.7, 1.951, 3.854},
              {0.8, 2.1362, 4.108}, {0.9, 2.3539, 4.412}, {1.0, 2.6087, 4.728}};
  const double period = drop_oscillation_period(density, diameter / 2, tension);
  for (const auto& run : runs) {
    const double spread = expected_spread(weber_number(density, run.speed, diameter, tension));
    EXPECT_NEAR(spread / run.spread, 1.0, 0.04) << run.speed;
    EXPECT_NEAR(1e3 * expected_contact_time(period, spread) / run.contact_time, 1.0, 0.05) << run.speed;
  }
  EXPECT_NEAR(expected_spread(weber_number(density, 2.0, diameter, tension)) / 5.5115, 1.0, 0.08);
}

TEST(ImpactEstimates, ThePapersContactTimeScalesWithTheDropsPeriod) {
  const double period = drop_oscillation_period(density, diameter / 2, tension);
  EXPECT_NEAR(contact_time_of_the_paper(period), 3.17e-3, 1e-6);
  EXPECT_DOUBLE_EQ(contact_time_of_the_paper(8 * period), 8 * contact_time_of_the_paper(period));
}

TEST(ImpactEstimates, TheFilmHasTheDropsArea) {
  const double spread = 2.5;
  EXPECT_DOUBLE_EQ(film_thickness(diameter, spread) * spread * diameter, round_drop_mass(1.0, diameter));
}

}  // namespace
}  // namespace sphdrop
