#include <gtest/gtest.h>

#include <limits>

#include "time_integration/due_time.hpp"

namespace sphdrop {
namespace {

TEST(NextMultiple, IsTheFirstAfterATimeOfEitherSign) {
  EXPECT_DOUBLE_EQ(next_multiple(0, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(next_multiple(0.7, 0.5), 1);
  EXPECT_DOUBLE_EQ(next_multiple(-0.7, 0.5), -0.5);
  EXPECT_DOUBLE_EQ(next_multiple(-0.2, 0.5), 0);
}

TEST(NextMultiple, TakesATimeWithinRoundingOfAMultipleForIt) {
  for (int k = -1000; k <= 1000; ++k) {
    const double multiple = 1e-5 * k;
    const double rounding = 1e-15 * multiple;
    for (const double time : {multiple - rounding, multiple, multiple + rounding})
      EXPECT_NEAR(next_multiple(time, 1e-5), 1e-5 * (k + 1), 1e-15) << time;
  }
}

TEST(NextMultiple, NeverComesWithoutAnInterval) {
  EXPECT_EQ(next_multiple(3, 0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace sphdrop
