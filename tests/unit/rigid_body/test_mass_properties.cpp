// Mass, mass centre and moment of inertia of bodies of particles.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "rigid_body/mass_properties.hpp"
#include "setup/droplet.hpp"

namespace sphdrop {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double density = 1200.0, diameter = 1e-3;

MassProperties of_particles(const DropParticles& drop) {
  return mass_properties(drop.positions, drop.masses);
}

// Worked out by hand: masses 1 and 3 at a distance of 4.
TEST(MassProperties, OfTwoParticles) {
  const std::vector<Vector> positions{{1.0, 2.0}, {5.0, 2.0}};
  const std::vector<double> masses{1.0, 3.0};
  const MassProperties body = mass_properties(positions, masses);
  EXPECT_DOUBLE_EQ(body.mass, 4.0);
  EXPECT_DOUBLE_EQ(body.centre.x, 4.0);
  EXPECT_DOUBLE_EQ(body.centre.y, 2.0);
  EXPECT_DOUBLE_EQ(body.moment_of_inertia, 1.0 * 9.0 + 3.0 * 1.0);
}

// n rings of point masses have exactly 1 - 1/(2 n^2) of a disc's M R^2/2.
TEST(MassProperties, OfRingsConvergeToThoseOfADisc) {
  const double radius = 0.5 * diameter;
  const double mass = density * pi * radius * radius, inertia = 0.5 * mass * radius * radius;
  for (const int rings : {5, 10, 20, 40}) {
    const MassProperties disc = of_particles(round_drop_of_rings(radius, radius / rings, density).all());
    EXPECT_NEAR(disc.mass / mass, 1.0, 1e-13) << rings;
    EXPECT_NEAR(disc.moment_of_inertia / inertia, 1.0 - 0.5 / (rings * rings), 1e-12) << rings;
    EXPECT_LT(length(disc.centre), 1e-13 * radius) << rings;
  }
}

// n x n point masses have exactly 1 - 1/n^2 of a square's M a^2/6.
TEST(MassProperties, OfALatticeConvergeToThoseOfASquare) {
  const double mass = density * diameter * diameter, inertia = mass * diameter * diameter / 6.0;
  for (const int n : {4, 10, 40}) {
    const MassProperties square = of_particles(square_drop(diameter, diameter / n, density).all());
    EXPECT_NEAR(square.mass / mass, 1.0, 1e-13) << n;
    EXPECT_NEAR(square.moment_of_inertia / inertia, 1.0 - 1.0 / (n * n), 1e-12) << n;
  }
}

TEST(MassProperties, AreThoseOfTheBodyWhereverItIs) {
  DropParticles drop = square_drop(diameter, diameter / 10, density).all();
  const MassProperties here = of_particles(drop);
  for (Vector& position : drop.positions) position += Vector{0.02, -0.01};
  const MassProperties there = of_particles(drop);
  EXPECT_NEAR(there.moment_of_inertia / here.moment_of_inertia, 1.0, 1e-12);
  EXPECT_NEAR(there.centre.x, 0.02, 1e-16);
  EXPECT_NEAR(there.centre.y, -0.01, 1e-16);
}

}  // namespace
}  // namespace sphdrop
