#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fluid/gauge_pressure.hpp"
#include "tests/support/random_numbers.hpp"

namespace sphdrop {
namespace {

constexpr double scale = 2.5e6;  // Pa
constexpr double unit = scale * 0x1p-31;

double target_of(const std::vector<double>& pressures, double lowest = 0.0) {
  PressureSums sums(scale);
  for (const double p : pressures) sums.add(p);
  return sums.target(sums.words(), static_cast<double>(pressures.size()), lowest);
}

TEST(PressureSums, TargetIsTheMeanLessThreeStandardDeviations) {
  EXPECT_NEAR(target_of({90, 110, 110, 90}), 70.0, 4 * unit);
  EXPECT_NEAR(target_of({100, 100, 100}), 100.0, unit);
  EXPECT_NEAR(target_of({1e5, 1.1e5, 0.9e5, 1e5}), 1e5 - 3 * std::sqrt(0.5) * 1e4, 4 * unit);
}

TEST(PressureSums, TargetIsNeverNegativeAndZeroForNothing) {
  EXPECT_EQ(target_of({10, 30}), 0.0);
  EXPECT_EQ(target_of({-100, -100}), 0.0);
  EXPECT_EQ(target_of({}), 0.0);
}

TEST(PressureSums, TargetFallsBelowZeroAsFarAsAllowed) {
  EXPECT_NEAR(target_of({10, 30}, -100.0), -10.0, 4 * unit);
  EXPECT_NEAR(target_of({-40, -20}, -100.0), -60.0, 4 * unit);
  EXPECT_EQ(target_of({-300, -100}, -100.0), -100.0);
  EXPECT_NEAR(target_of({90, 110, 110, 90}, -100.0), 70.0, 4 * unit);
}

TEST(PressureSums, AddUpOverPartsToTheSameBits) {
  test::RandomNumbers random(90);
  PressureSums whole(scale);
  std::vector<PressureSums> parts(3, PressureSums(scale));
  for (int k = 0; k < 3000; ++k) {
    const double p = random.between(-1, 1) * (k % 5 == 0 ? scale : 200.0);
    whole.add(p);
    parts[static_cast<std::size_t>(k * 7 % 3)].add(p);
  }
  PressureSums::Words sum{};
  for (const PressureSums& part : parts)
    for (std::size_t w = 0; w < sum.size(); ++w) sum[w] += part.words()[w];
  EXPECT_EQ(sum, whole.words());
}

// What would overflow counts as the scale, so that a wild particle does no more harm than that.
TEST(PressureSums, LimitWhatIsBeyondTheScale) {
  PressureSums wild(scale), limited(scale);
  for (const double p : {1e300, -1e300, 2 * scale, std::numeric_limits<double>::infinity()}) wild.add(p);
  for (const double p : {scale, -scale, scale, scale}) limited.add(p);
  EXPECT_EQ(wild.words(), limited.words());
  // A thousand million of the largest stay far from overflow.
  EXPECT_LT(static_cast<double>(limited.words()[2]) / 4 * 1e9, 0x1p63);
  EXPECT_LT(static_cast<double>(limited.words()[1]) / 4 * 1e9, 0x1p63);
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
