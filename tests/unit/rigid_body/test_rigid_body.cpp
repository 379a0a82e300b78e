// A rigid body's motion, alone.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "rigid_body/rigid_body.hpp"

namespace sphdrop {
namespace {

constexpr double pi = std::numbers::pi;

RigidBody moving_body() {
  RigidBody body({2.0, {0.3, -0.4}, 0.5});
  body.staggered_velocity = {1.0, -2.0};
  body.staggered_spin = 3.0;
  return body;
}

TEST(Rotation, TurnsCounterclockwise) {
  const Vector up = rotation_by(0.5 * pi)({2.0, 0.0});
  EXPECT_NEAR(up.x, 0.0, 1e-15);
  EXPECT_NEAR(up.y, 2.0, 1e-15);
  const Vector turned = rotation_by(-0.7)({1.0, 2.0});
  EXPECT_NEAR(turned.x, std::cos(0.7) + 2.0 * std::sin(0.7), 1e-15);
  EXPECT_NEAR(turned.y, -std::sin(0.7) + 2.0 * std::cos(0.7), 1e-15);
}

// However often it has turned: distances and angles between points are kept, and whole turns change nothing.
TEST(Rotation, KeepsDistancesAfterAnyNumberOfTurns) {
  const Vector a{0.5e-3, -0.1e-3}, b{-0.3e-3, 0.4e-3};
  for (const double angle : {0.0, 1e-9, 0.7, -3.0, 50.0, -1234.5, 1e6, 3e9}) {
    const Rotation turn = rotation_by(angle);
    EXPECT_NEAR(length(turn(a) - turn(b)) / length(a - b), 1.0, 1e-15) << angle;
    EXPECT_NEAR(dot(turn(a), turn(b)) / dot(a, b), 1.0, 5e-15) << angle;
  }
  EXPECT_NEAR(rotation_by(200.0 * pi + 0.3).sine, std::sin(0.3), 1e-13);
  EXPECT_NEAR(rotation_by(-200.0 * pi + 0.3).cosine, std::cos(0.3), 1e-13);
}

TEST(RigidVelocity, IsThatOfTheCentreAndOfTheTurn) {
  const Vector v = rigid_velocity({1.0, 2.0}, 10.0, {0.3, -0.2});
  EXPECT_DOUBLE_EQ(v.x, 1.0 + 10.0 * 0.2);
  EXPECT_DOUBLE_EQ(v.y, 2.0 + 10.0 * 0.3);
}

TEST(Moment, AboutAnotherPoint) {
  // A force up at (3, 1): about the origin 3 F, about (1, 5) 2 F.
  const Vector force{0.0, 4.0};
  EXPECT_DOUBLE_EQ(moment_about({1.0, 5.0}, force, cross(Vector{3.0, 1.0}, force)), 8.0);
}

TEST(RigidBody, WithoutForcesKeepsVelocityAndSpin) {
  RigidBody body = moving_body();
  body.accelerate({}, 0.0);
  double time = 0;
  for (int k = 0; k < 1000; ++k) {
    const double step = 1e-3 * (1 + k % 3);
    body.kick_and_drift(k == 0 ? 0.5 * step : step, step);
    time += step;
  }
  EXPECT_EQ(body.staggered_velocity, (Vector{1.0, -2.0}));
  EXPECT_EQ(body.staggered_spin, 3.0);
  EXPECT_NEAR(body.centre.x, 0.3 + time, 1e-12);
  EXPECT_NEAR(body.centre.y, -0.4 - 2.0 * time, 1e-12);
  EXPECT_NEAR(body.angle, 3.0 * time, 1e-12);
}

// The leap-frog is exact for constant force and moment, with steps of any length.
TEST(RigidBody, IsExactUnderConstantForceAndMoment) {
  RigidBody body = moving_body();
  const Vector force{3.0, -1.0};
  const double moment = 0.25;
  const Vector a = force / 2.0;
  const double alpha = moment / 0.5;
  double time = 0, previous = 0;
  for (int k = 0; k < 100; ++k) {
    body.predict(previous);
    EXPECT_NEAR(body.velocity.x, 1.0 + a.x * time, 1e-12);
    EXPECT_NEAR(body.velocity.y, -2.0 + a.y * time, 1e-12);
    EXPECT_NEAR(body.spin, 3.0 + alpha * time, 1e-12);
    EXPECT_NEAR(body.centre.x, 0.3 + time + 0.5 * a.x * time * time, 1e-12);
    EXPECT_NEAR(body.centre.y, -0.4 - 2.0 * time + 0.5 * a.y * time * time, 1e-12);
    EXPECT_NEAR(body.angle, 3.0 * time + 0.5 * alpha * time * time, 1e-12);
    body.accelerate(force, moment);
    const double next = 0.01 * (1 + k % 5);
    body.kick_and_drift(0.5 * (previous + next), next);
    time += next;
    previous = next;
  }
}

TEST(RigidBody, OfOnePointDoesNotTurn) {
  RigidBody body({1.0, {}, 0.0});
  body.accelerate({1.0, 0.0}, 1.0);
  EXPECT_EQ(body.angular_acceleration, 0.0);
}

TEST(RigidBody, ComesBackFromItsNumbersBitForBit) {
  RigidBody body = moving_body();
  body.accelerate({0.1, 0.7}, 0.3);
  for (int k = 0; k < 5; ++k) {
    body.predict(0.01);
    body.kick_and_drift(0.01, 0.01);
  }
  const std::vector<double> numbers = body.to_numbers();
  EXPECT_EQ(RigidBody::from_numbers(numbers), body);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    std::vector<double> changed = numbers;
    changed[k] += 1.0;
    EXPECT_NE(RigidBody::from_numbers(changed), body) << "number " << k << " is lost";
  }
}

TEST(RigidBody, RefusesNumbersOfNoBody) {
  std::vector<double> numbers = moving_body().to_numbers();
  EXPECT_THROW(RigidBody::from_numbers({}), std::invalid_argument);
  numbers.push_back(0.0);
  EXPECT_THROW(RigidBody::from_numbers(numbers), std::invalid_argument);
  numbers.pop_back();
  numbers[0] = 0.0;
  EXPECT_THROW(RigidBody::from_numbers(numbers), std::invalid_argument);
}

}  // namespace
}  // namespace sphdrop
