#include "diagnostics/contact_record.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sphdrop {
namespace {

TEST(ContactRecord, EmptyBeforeContact) {
  ContactRecord record;
  record.add(0.0, 1e-6, 0, {});
  EXPECT_FALSE(record.first_contact());
  EXPECT_FALSE(record.last_contact());
  EXPECT_FALSE(record.impulse_time());
  EXPECT_TRUE(record.gaps().empty());
  EXPECT_EQ(record.impulse(), Vector{});
}

TEST(ContactRecord, FirstLastAndGapsAboveTheLimitOnly) {
  const double dt = std::exp2(-20.0);  // 0.95 us: times are exact
  ContactRecord record(1e-6, 20e-6);
  const auto touches = [](int step) {
    return (step >= 10 && step < 100) || (step >= 110 && step < 200) ||  // 10 us apart: chatter
           (step >= 250 && step < 300) || (step >= 400 && step < 401);
  };
  for (int step = 0; step < 1000; ++step) record.add(step * dt, dt, touches(step) ? 3 : 0, {});
  EXPECT_EQ(record.first_contact(), 10 * dt);
  EXPECT_EQ(record.last_contact(), 400 * dt);
  const std::vector<ContactRecord::Gap> expected{{199 * dt, 250 * dt}, {299 * dt, 400 * dt}};
  EXPECT_EQ(record.gaps(), expected);
}

TEST(ContactRecord, GapOfExactlyTheLimitIsNone) {
  ContactRecord record(1.0, 4.0);
  record.add(0.0, 1.0, 1, {});
  record.add(4.0, 1.0, 1, {});
  EXPECT_TRUE(record.gaps().empty());
  record.add(8.5, 1.0, 1, {});
  EXPECT_EQ(record.gaps(), (std::vector<ContactRecord::Gap>{{4.0, 8.5}}));
}

TEST(ContactRecord, ImpulseIsForceTimesTimeOfBothComponents) {
  ContactRecord record;
  record.add(0.0, 0.5, 1, {2.0, -8.0});
  record.add(0.5, 0.25, 1, {4.0, -16.0});
  EXPECT_EQ(record.impulse(), (Vector{2.0, -8.0}));
}

/// Feeds a half-sine pulse of force from start to start + duration in steps of dt until end.
void feed_pulse(ContactRecord& record, double start, double duration, double dt, double end, double sign) {
  const auto steps = static_cast<int>(std::lround(end / dt));
  for (int step = 0; step < steps; ++step) {
    const double time = step * dt, phase = (time + 0.5 * dt - start) / duration;
    const bool touching = phase > 0.0 && phase < 1.0;
    record.add(time, dt, touching ? 5 : 0, {0.0, touching ? sign * std::sin(std::numbers::pi * phase) : 0.0});
  }
}

/// (1 - cos(pi s))/2 = f.
double pulse_fraction_time(double f) {
  return std::acos(1.0 - 2.0 * f) / std::numbers::pi;
}

TEST(ContactRecord, TimeByWhichAFractionIsGiven) {
  for (const double sign : {1.0, -1.0}) {
    ContactRecord record(1e-6);
    feed_pulse(record, 0.2e-3, 3e-3, 30e-9, 5e-3, sign);
    EXPECT_NEAR(record.impulse().y, sign * 3e-3 * 2.0 / std::numbers::pi, 1e-9);
    for (const double fraction : {0.1, 0.5, 0.99})
      EXPECT_NEAR(record.impulse_time(fraction).value(), 0.2e-3 + 3e-3 * pulse_fraction_time(fraction), 5e-8);
  }
}

TEST(ContactRecord, BoundedMemoryStaysAccurate) {
  ContactRecord record(1e-6, 20e-6, 64);
  feed_pulse(record, 0.2e-3, 3e-3, 100e-9, 5e-3, 1.0);
  EXPECT_LE(record.to_numbers().size(), 11u + 2u * 64u);
  EXPECT_GE(record.to_numbers().size(), 11u + 2u * 30u);
  for (const double fraction : {0.1, 0.5, 0.99})
    EXPECT_NEAR(record.impulse_time(fraction).value(), 0.2e-3 + 3e-3 * pulse_fraction_time(fraction), 2e-5);
}

TEST(ContactRecord, PauseInTheImpulseIsNotSmearedOut) {
  // 90 % at once, nothing for a long while, then the rest: half is given early, 99 % late.
  ContactRecord record(1.0, 20.0, 1024);
  const auto force = [](int step) { return step < 9 ? 10.0 : step >= 5000 && step < 5010 ? 1.0 : 0.0; };
  for (int step = 0; step < 6000; ++step) record.add(step, 1.0, force(step) > 0.0 ? 1 : 0, {0.0, force(step)});
  EXPECT_NEAR(record.impulse_time(0.5).value(), 5.0, 1e-12);
  EXPECT_NEAR(record.impulse_time(0.905).value(), 5000.5, 1e-9);  // within the first step after the pause
  EXPECT_NEAR(record.impulse_time(0.99).value(), 5009.0, 1e-9);
  EXPECT_LT(record.to_numbers().size(), 100u);
}

TEST(ContactRecord, NumbersRoundTripExactlyAndTheRunGoesOnAlike) {
  ContactRecord through(1e-6, 20e-6, 128);
  feed_pulse(through, 0.1e-3, 1e-3, 0.3e-6, 1.5e-3, 1.0);
  through.add(1.6e-3, 0.1e-6, 1, {0.1, 0.3});
  const auto numbers = through.to_numbers();
  ContactRecord restored = ContactRecord::from_numbers(numbers);
  EXPECT_EQ(restored, through);
  const auto again = restored.to_numbers();
  ASSERT_EQ(again.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again[i]), std::bit_cast<std::uint64_t>(numbers[i]));
  EXPECT_EQ(restored.gaps().size(), 1u);
  for (int step = 0; step < 500; ++step) {
    through.add(2e-3 + step * 1e-6, 1e-6, step % 50 == 0 ? 1 : 0, {step * 0.1, 1.0 / (1 + step)});
    restored.add(2e-3 + step * 1e-6, 1e-6, step % 50 == 0 ? 1 : 0, {step * 0.1, 1.0 / (1 + step)});
  }
  EXPECT_EQ(restored, through);
  EXPECT_GT(through.gaps().size(), 5u);
}

TEST(ContactRecord, RefusesNumbersOfAnotherKind) {
  ContactRecord record;
  feed_pulse(record, 0.0, 1e-4, 1e-6, 2e-4, 1.0);
  const auto good = record.to_numbers();
  auto numbers = good;
  numbers.pop_back();
  EXPECT_THROW(ContactRecord::from_numbers(numbers), std::invalid_argument);
  numbers = good;
  numbers.push_back(0.0);
  EXPECT_THROW(ContactRecord::from_numbers(numbers), std::invalid_argument);
  numbers = good;
  numbers[3] = 0.5;  // the flag
  EXPECT_THROW(ContactRecord::from_numbers(numbers), std::invalid_argument);
  for (const double count : {-1.0, 0.5, 1e300, static_cast<double>(NAN)}) {
    numbers = good;
    numbers[9] = count;  // of gaps
    EXPECT_THROW(ContactRecord::from_numbers(numbers), std::invalid_argument) << count;
  }
  EXPECT_THROW(ContactRecord::from_numbers({}), std::invalid_argument);
}

TEST(ContactRecord, RefusesImpossibleSettings) {
  EXPECT_THROW(ContactRecord(0.0), std::invalid_argument);
  EXPECT_THROW(ContactRecord(1e-6, -1.0), std::invalid_argument);
  EXPECT_THROW(ContactRecord(1e-6, 20e-6, 3), std::invalid_argument);
}

}  // namespace
}  // namespace sphdrop
