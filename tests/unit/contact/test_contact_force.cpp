#include <gtest/gtest.h>

#include "contact/contact_force.hpp"

namespace sphdrop {
namespace {

TEST(SpringRate, IsTheStiffnessOverTheSquaredTimeStep) {
  EXPECT_DOUBLE_EQ(time_step_spring_rate(0.1, 5e-9), 4e15);
}

TEST(ContactAcceleration, GrowsWithTheOverlapAlongTheNormal) {
  FootPoint foot{.segment = 0, .normal = {0.6, 0.8}, .distance = 0.9};
  const Vector f = contact_acceleration(foot, 50.0, 1.0);
  EXPECT_NEAR(f.x, 50.0 * 0.1 * 0.6, 1e-13);
  EXPECT_NEAR(f.y, 50.0 * 0.1 * 0.8, 1e-13);
  foot.distance = -0.5;  // inside the solid: farther in, pushed harder, still outward
  EXPECT_NEAR(contact_acceleration(foot, 50.0, 1.0).y, 50.0 * 1.5 * 0.8, 1e-12);
}

TEST(ContactAcceleration, VanishesFromTheContactDistanceOn) {
  FootPoint foot{.segment = 0, .normal = {0, 1}, .distance = 1.0};
  EXPECT_EQ(contact_acceleration(foot, 50.0, 1.0), Vector{});
  EXPECT_EQ(contact_energy(foot, 50.0, 1.0), 0.0);
  foot.distance = 3.0;
  EXPECT_EQ(contact_acceleration(foot, 50.0, 1.0), Vector{});
  EXPECT_EQ(contact_energy(foot, 50.0, 1.0), 0.0);
}

TEST(ContactEnergy, IsThePotentialOfTheAcceleration) {
  const double k = 50.0, d0 = 1.0, step = 1e-5;
  for (const double distance : {-0.4, 0.2, 0.7, 0.99}) {
    const auto energy = [&](double at) { return contact_energy({.normal = {0, 1}, .distance = at}, k, d0); };
    const double slope = (energy(distance + step) - energy(distance - step)) / (2 * step);
    EXPECT_NEAR(contact_acceleration({.normal = {0, 1}, .distance = distance}, k, d0).y, -slope, 1e-8);
  }
}

TEST(SharedForce, BalancesForceAndMomentAboutAnyPoint) {
  const Vector a{0.3, 0.1}, b{1.1, 0.7}, force{-3.7, 9.1};
  for (const double fraction : {0.0, 0.1, 1.0 / 3, 0.5, 0.77, 1.0}) {
    const SharedForce share = shared_force(force, fraction);
    const Vector foot = a + fraction * (b - a);
    EXPECT_NEAR(share.first.x + share.second.x, force.x, 1e-15 * 10);
    EXPECT_NEAR(share.first.y + share.second.y, force.y, 1e-15 * 10);
    // F1 S1 = F2 S2
    EXPECT_NEAR(length(share.first) * length(a - foot), length(share.second) * length(b - foot), 1e-14);
    for (const Vector about : {Vector{0, 0}, Vector{5, -3}, Vector{0.7, 0.4}})
      EXPECT_NEAR(cross(a - about, share.first) + cross(b - about, share.second), cross(foot - about, force), 1e-13);
  }
}

TEST(SharedForce, GivesTheNearerEndMoreAndAVertexAll) {
  const Vector force{0, -8};
  const SharedForce near_first = shared_force(force, 0.25);
  EXPECT_DOUBLE_EQ(near_first.first.y, -6);
  EXPECT_DOUBLE_EQ(near_first.second.y, -2);
  EXPECT_EQ(shared_force(force, 0.0).first, force);
  EXPECT_EQ(shared_force(force, 0.0).second, Vector{});
  EXPECT_EQ(shared_force(force, 1.0).first, Vector{});
  EXPECT_EQ(shared_force(force, 1.0).second, force);
}

}  // namespace
}  // namespace sphdrop
