#include <gtest/gtest.h>

#include <cmath>

#include "fluid/gauge_pressure.hpp"

namespace sphdrop {
namespace {

TEST(GaugeTarget, IsTheMeanLessThreeStandardDeviations) {
  // 90 and 110, half each: mean 100, deviation 10.
  EXPECT_NEAR(gauge_target(4 * 100, 2 * (90 * 90 + 110 * 110), 4), 70.0, 1e-12);
  EXPECT_NEAR(gauge_target(300, 3 * 100 * 100, 3), 100.0, 1e-12);
}

TEST(GaugeTarget, IsNeverNegativeAndZeroForNothing) {
  EXPECT_EQ(gauge_target(4 * 20, 2 * (10 * 10 + 30 * 30), 4), 0.0);
  EXPECT_EQ(gauge_target(-500, 100 * 100 * 5, 5), 0.0);
  EXPECT_EQ(gauge_target(0, 0, 0), 0.0);
}

TEST(GaugePressure, FollowsItsTargetInTheRelaxationTime) {
  GaugePressure gauge{0.0, 100.0};
  double sum = 0;
  for (int k = 0; k < 2000; ++k) sum += gauge.relax(1e-8, 20e-6);
  EXPECT_NEAR(gauge.pressure, 100 * (1 - std::exp(-1.0)), 0.02);
  EXPECT_NEAR(sum, gauge.pressure, 1e-10);
  EXPECT_EQ(gauge.relax(0.0, 20e-6), 0.0);
}

TEST(GaugePressure, DoesNotOvershootInALongStep) {
  GaugePressure gauge{10.0, 100.0};
  EXPECT_EQ(gauge.relax(1.0, 20e-6), 90.0);
  EXPECT_EQ(gauge.pressure, 100.0);
}

}  // namespace
}  // namespace sphdrop
