#include <gtest/gtest.h>

#include <cmath>

#include "contact/contact_force.hpp"

namespace sphdrop {
namespace {

TEST(SpringRate, IsTheStiffnessOverTheSquaredTimeStep) {
  EXPECT_DOUBLE_EQ(time_step_spring_rate(0.1, 5e-9), 4e15);
}

TEST(SpringRate, OfAFixedStiffnessGivesEveryParticleTheSameForcePerOverlap) {
  const double stiffness = 7.5e5;  // 0.3 rho c_f^2 of water at 50 m/s, Pa
  for (const double mass : {6.25e-7, 1.3e-6}) {
    const FootPoint foot{.segment = 0, .normal = {0, 1}, .distance = 2e-5};
    const Vector f = contact_acceleration(foot, fixed_spring_rate(stiffness, mass), 2.5e-5);
    EXPECT_DOUBLE_EQ(mass * f.y, stiffness * (2.5e-5 - 2e-5));
    EXPECT_DOUBLE_EQ(mass * contact_energy(foot, fixed_spring_rate(stiffness, mass), 2.5e-5),
                     0.5 * stiffness * (2.5e-5 - 2e-5) * (2.5e-5 - 2e-5));
  }
}

TEST(ContactDamping, OpposesTheNormalVelocityAndNeverPulls) {
  const double k = 50.0, d0 = 1.0, ratio = 0.1;
  const FootPoint foot{.segment = 0, .normal = {0.6, 0.8}, .distance = 0.9};
  const double damper = 2.0 * ratio * std::sqrt(k);
  const Vector inwards = contact_damping(foot, k, d0, ratio, {-0.6 * 3 + 0.8, -0.8 * 3 - 0.6});  // 3 in, 1 along
  EXPECT_NEAR(inwards.x, damper * 3 * 0.6, 1e-13);
  EXPECT_NEAR(inwards.y, damper * 3 * 0.8, 1e-13);
  const Vector slowly_out = contact_damping(foot, k, d0, ratio, 0.3 * foot.normal);
  EXPECT_NEAR(dot(slowly_out, foot.normal), -damper * 0.3, 1e-13);
  const Vector fast_out = contact_damping(foot, k, d0, ratio, 300.0 * foot.normal);
  EXPECT_NEAR(length(fast_out + contact_acceleration(foot, k, d0)), 0.0, 1e-13);
  EXPECT_EQ(contact_damping({.normal = {0, 1}, .distance = 1.0}, k, d0, ratio, {0, -5}), Vector{});
}

TEST(WallDrag, ActsAlongTheWallOnly) {
  FootPoint foot{.segment = 0, .normal = {0.6, 0.8}, .distance = 0.9};
  EXPECT_EQ(length(wall_drag(foot, 7.0, 2.0 * foot.normal)), 0.0);
  const Vector along{0.8, -0.6};
  const Vector drag = wall_drag(foot, 7.0, 2.0 * along - 5.0 * foot.normal);
  EXPECT_NEAR(length(drag + 14.0 * along), 0.0, 1e-13);
  foot.at_vertex = true;
  EXPECT_EQ(wall_drag(foot, 7.0, along), Vector{});
}

TEST(SharedMoment, IsAPairOfOppositeForces) {
  const Vector a{0.3, 0.1}, b{1.1, 0.7};
  const SharedForce pair = shared_moment(-2.5, a, b);
  EXPECT_EQ(pair.first, -pair.second);
  EXPECT_NEAR(cross(a, pair.first) + cross(b, pair.second), -2.5, 1e-14);
  EXPECT_NEAR(dot(pair.first, b - a), 0.0, 1e-14);
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
