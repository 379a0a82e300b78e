#include "diagnostics/extremes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sphdrop {
namespace {

double parabola(double t) {
  return 2.0 - 3.0 * (t - 1.3) * (t - 1.3);
}

TEST(PeakTracker, RefinesAParabolaExactlyEvenAtUnevenTimes) {
  PeakTracker tracker;
  for (const double t : {0.0, 0.4, 1.0, 1.45, 1.9, 2.0}) tracker.add(t, parabola(t));
  EXPECT_EQ(tracker.sampled().value(), (Peak{1.45, parabola(1.45)}));
  EXPECT_NEAR(tracker.refined().value().time, 1.3, 1e-12);
  EXPECT_NEAR(tracker.refined().value().value, 2.0, 1e-12);
}

TEST(PeakTracker, TakesTheHighestOfSeveralPeaks) {
  PeakTracker tracker;
  const double values[] = {0, 1, 0, 2, 5, 3, 0, 4, 1};
  for (int i = 0; i < 9; ++i) tracker.add(i, values[i]);
  EXPECT_EQ(tracker.sampled().value(), (Peak{4.0, 5.0}));
  EXPECT_NEAR(tracker.refined().value().time, 4.1, 1e-12);  // through 2, 5, 3
  EXPECT_NEAR(tracker.refined().value().value, 5.025, 1e-12);
}

TEST(PeakTracker, EdgesAndPlateausStayAsSampled) {
  PeakTracker rising, falling, plateau;
  EXPECT_FALSE(rising.sampled());
  EXPECT_FALSE(rising.refined());
  for (int i = 0; i < 4; ++i) {
    rising.add(i, i);
    falling.add(i, -i);
    plateau.add(i, i == 1 || i == 2 ? 1.0 : 0.0);
  }
  EXPECT_EQ(rising.refined().value(), (Peak{3.0, 3.0}));
  EXPECT_EQ(falling.refined().value(), (Peak{0.0, 0.0}));
  EXPECT_EQ(plateau.refined().value(), (Peak{1.0, 1.0}));
}

TEST(PeakTracker, ARepeatedInstantIsPassedOver) {
  PeakTracker once, twice;
  for (int i = 0; i < 5; ++i) {
    once.add(i, -(i - 2.2) * (i - 2.2));
    twice.add(i, -(i - 2.2) * (i - 2.2));
    twice.add(i, -(i - 2.2) * (i - 2.2));
  }
  EXPECT_EQ(once, twice);
  EXPECT_NEAR(once.refined().value().time, 2.2, 1e-12);
}

TEST(ReboundTracker, RatioOfSpeedsBeforeTheFirstAndAfterTheLastContact) {
  ReboundTracker tracker;
  tracker.add(false, -0.79);
  tracker.add(false, -0.8);
  EXPECT_FALSE(tracker.restitution());
  tracker.add(true, -0.7);  // slowed down already
  tracker.add(true, -0.3);
  EXPECT_FALSE(tracker.restitution());
  tracker.add(false, 0.1);
  EXPECT_DOUBLE_EQ(tracker.restitution().value(), 0.125);
  tracker.add(true, 0.1);  // touches again
  EXPECT_FALSE(tracker.restitution());
  tracker.add(false, 0.4);
  tracker.add(false, 0.39);  // gravity slows it in flight
  EXPECT_DOUBLE_EQ(tracker.restitution().value(), 0.5);
}

TEST(ReboundTracker, InContactFromTheStart) {
  ReboundTracker tracker;
  tracker.add(true, -0.5);
  tracker.add(true, 0.1);
  tracker.add(false, 0.4);
  EXPECT_DOUBLE_EQ(tracker.restitution().value(), 0.8);
}

Extremes fed(int from, int to, Extremes extremes = {}) {
  for (int i = from; i < to; ++i) {
    const double t = 0.01 * i;
    extremes.add(t, 1.0 + std::sin(t), 0.1 - std::sin(1.7 * t), i > 50 && i < 150 ? 4 : 0, -1.0 + t);
  }
  return extremes;
}

TEST(Extremes, WidthDepthAndRestitution) {
  const Extremes extremes = fed(0, 200);
  EXPECT_NEAR(extremes.width().refined().value().time, 1.570796, 1e-5);
  EXPECT_NEAR(extremes.width().refined().value().value, 2.0, 1e-8);
  EXPECT_DOUBLE_EQ(extremes.width().sampled().value().time, 1.57);
  EXPECT_NEAR(extremes.depth().refined().value().time, 1.570796 / 1.7, 1e-5);
  EXPECT_NEAR(extremes.depth().refined().value().value, 0.9, 1e-8);
  EXPECT_NEAR(extremes.restitution().value(), 0.5 / 0.5, 1e-12);
}

TEST(Extremes, NumbersRoundTripExactlyAtAnyInstant) {
  for (const int cut : {0, 1, 2, 51, 92, 93, 94, 150, 157, 158}) {
    const Extremes before = fed(0, cut);
    const Extremes restored = Extremes::from_numbers(before.to_numbers());
    EXPECT_EQ(restored, before) << cut;
    EXPECT_EQ(fed(cut, 200, restored), fed(0, 200)) << cut;
  }
}

TEST(Extremes, RefusesNumbersOfAnotherKind) {
  auto numbers = fed(0, 20).to_numbers();
  numbers.push_back(1.0);
  EXPECT_THROW(Extremes::from_numbers(numbers), std::invalid_argument);
  numbers.resize(numbers.size() - 2);
  EXPECT_THROW(Extremes::from_numbers(numbers), std::invalid_argument);
  numbers.push_back(0.0);
  EXPECT_NO_THROW(Extremes::from_numbers(numbers));
  numbers[0] = 7.0;
  EXPECT_THROW(Extremes::from_numbers(numbers), std::invalid_argument);
}

}  // namespace
}  // namespace sphdrop
