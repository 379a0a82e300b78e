#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "setup/droplet.hpp"
#include "setup/split_mix.hpp"

namespace sphdrop {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 0.5e-3, d = 0.025e-3, density = 1000;

double total_mass(const DropParticles& drop) {
  return std::accumulate(drop.masses.begin(), drop.masses.end(), 0.0);
}

double smallest_distance(const std::vector<Vector>& positions) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, length(positions[i] - positions[j]));
  return smallest;
}

Vector mass_centre(const DropParticles& drop) {
  Vector centre;
  for (std::size_t i = 0; i < drop.masses.size(); ++i) centre += drop.masses[i] * drop.positions[i];
  return centre / total_mass(drop);
}

TEST(RingDrop, HasTheRingsOfItsDefinition) {
  const DropParticles drop = round_drop_of_rings(radius, d, density).all();
  std::size_t i = 0;
  for (int k = 0; k < 20; ++k) {
    const auto count = static_cast<std::size_t>(std::lround(2 * pi * (k + 0.5)));
    double mass = 0;
    for (std::size_t j = 0; j < count; ++j, ++i) {
      ASSERT_LT(i, drop.positions.size());
      EXPECT_NEAR(length(drop.positions[i]), (k + 0.5) * d, 1e-14 * radius);
      mass += drop.masses[i];
    }
    const double annulus = pi * d * d * ((k + 1) * (k + 1) - k * k);
    EXPECT_NEAR(mass, density * annulus, 1e-13 * density * annulus);
  }
  EXPECT_EQ(i, drop.positions.size());
  // As many as pi R^2 / d^2, give or take the rounding of each ring.
  EXPECT_NEAR(static_cast<double>(drop.positions.size()), pi * 400, 10);
}

TEST(RingDrop, HasTheMassOfTheDiscForAnySpacing) {
  for (const double spacing : {0.05e-3, 0.04166667e-3, 0.033e-3, 0.025e-3, 0.7e-3, 2e-3}) {
    const DropParticles drop = round_drop_of_rings(radius, spacing, density).all();
    const double disc = density * pi * radius * radius;
    EXPECT_NEAR(total_mass(drop), disc, 1e-13 * disc) << spacing;
    EXPECT_NEAR(length(mass_centre(drop)), 0.0, 1e-14 * radius) << spacing;
  }
}

TEST(RingDrop, KeepsParticlesApart) {
  for (const double spacing : {0.05e-3, 0.025e-3, 0.0125e-3})
    EXPECT_GT(smallest_distance(round_drop_of_rings(radius, spacing, density).all().positions), 0.85 * spacing);
}

TEST(RingDrop, SpacesParticlesEvenlyOnARing) {
  const DropParticles drop = round_drop_of_rings(radius, d, density).all();
  const std::size_t last_ring = drop.positions.size() - 123;  // round(39 pi)
  for (std::size_t i = last_ring; i + 1 < drop.positions.size(); ++i)
    EXPECT_NEAR(length(drop.positions[i + 1] - drop.positions[i]), 2 * 19.5 * d * std::sin(pi / 123), 1e-12 * radius);
}

TEST(RingDrop, DoesNotLineUpFromRingToRing) {
  // A ray meets a particle, to within 0.1 d, of one ring in five; were the rings not turned, the x axis would meet
  // all 20.
  const DropParticles drop = round_drop_of_rings(radius, d, density).all();
  for (int direction = 0; direction < 3600; ++direction) {
    const double angle = direction * 2 * pi / 3600;
    int lined_up = 0;
    for (const Vector& x : drop.positions) {
      const Vector axis{std::cos(angle), std::sin(angle)};
      if (dot(x, axis) > 0 && std::abs(cross(axis, x)) < 0.1 * d) ++lined_up;
    }
    EXPECT_LE(lined_up, 12) << angle;
  }
}

TEST(LatticeDrop, FillsTheDiscSymmetricallyWithEqualMasses) {
  const DropParticles drop = round_drop_of_lattice(radius, d, density).all();
  std::set<std::pair<double, double>> places;
  for (const Vector& x : drop.positions) places.insert({x.x, x.y});
  EXPECT_EQ(places.size(), drop.positions.size());
  for (const Vector& x : drop.positions) {
    EXPECT_LE(length(x), radius);
    for (const auto& image : {std::pair{-x.x, x.y}, std::pair{x.x, -x.y}, std::pair{x.y, x.x}})
      EXPECT_TRUE(places.contains(image));
  }
  std::size_t expected = 0;
  for (int i = -30; i < 30; ++i)
    for (int j = -30; j < 30; ++j)
      if ((i + 0.5) * (i + 0.5) + (j + 0.5) * (j + 0.5) <= 400) ++expected;
  EXPECT_EQ(drop.positions.size(), expected);
  EXPECT_NEAR(smallest_distance(drop.positions), d, 1e-12 * d);
  EXPECT_EQ(*std::min_element(drop.masses.begin(), drop.masses.end()),
            *std::max_element(drop.masses.begin(), drop.masses.end()));
  EXPECT_NEAR(total_mass(drop), density * pi * radius * radius, 1e-12 * density * pi * radius * radius);
}

TEST(SquareDrop, IsALatticeOfCellCentres) {
  for (const double spacing : {0.05e-3, 0.02e-3, 0.03e-3}) {
    const DropParticles drop = square_drop(1e-3, spacing, density).all();
    const int n = static_cast<int>(std::lround(1e-3 / spacing));
    ASSERT_EQ(drop.positions.size(), static_cast<std::size_t>(n * n));
    EXPECT_NEAR(total_mass(drop), density * 1e-6, 1e-13);
    EXPECT_NEAR(length(mass_centre(drop)), 0.0, 1e-18);
    EXPECT_NEAR(smallest_distance(drop.positions), 1e-3 / n, 1e-15);
    EXPECT_NEAR(drop.positions.front().x, -0.5e-3 + 0.5e-3 / n, 1e-17);
    EXPECT_NEAR(drop.positions.front().y, -0.5e-3 + 0.5e-3 / n, 1e-17);
    EXPECT_NEAR(drop.positions.back().x, 0.5e-3 - 0.5e-3 / n, 1e-17);
    EXPECT_EQ(drop.positions[1].x, drop.positions[0].x);  // column by column
  }
}

TEST(Jitter, StaysWithinItsAmplitudeAndFollowsItsSeed) {
  // All at one place.
  const auto moved = [](std::int64_t seed) {
    Drop drop(ListedParticles(std::vector<Vector>(2000), std::vector<double>(2000, 1.0)));
    drop.jitter(0.01, seed);
    return drop.all().positions;
  };
  const std::vector<Vector> first = moved(7), same = moved(7), other = moved(8);
  Vector mean, mean_square;
  for (const Vector& x : first) {
    EXPECT_LE(std::max(std::abs(x.x), std::abs(x.y)), 0.01);
    mean += x / 2000;
    mean_square += Vector{x.x * x.x, x.y * x.y} / 2000;
  }
  EXPECT_NEAR(mean.x, 0.0, 5e-4);
  EXPECT_NEAR(mean.y, 0.0, 5e-4);
  EXPECT_NEAR(mean_square.x, 1e-4 / 3, 3e-6);  // uniform: a^2/3
  EXPECT_NEAR(mean_square.y, 1e-4 / 3, 3e-6);
}

TEST(SplitMix64, GivesItsPublishedNumbers) {
  SplitMix64 random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317u);
  EXPECT_EQ(random.next(), 3203168211198807973u);
  EXPECT_EQ(random.next(), 9817491932198370423u);
}

TEST(SplitMix64, SkipsToAnyOfThem) {
  SplitMix64 random(1234567);
  random.skip(2);
  EXPECT_EQ(random.next(), 9817491932198370423u);
}

TEST(OscillationVelocity, IsTheFormulaOfThePaper) {
  const double v0 = 0.8, r0 = 0.25e-3, x = 0.1e-3, y = -0.2e-3, r = std::sqrt(x * x + y * y);
  const Vector v = oscillation_velocity({x, y}, v0, r0);
  EXPECT_NEAR(v.x, v0 * (x / r0) * (1 - y * y / (r0 * r)) * std::exp(-r / r0), 1e-15);
  EXPECT_NEAR(v.y, -v0 * (y / r0) * (1 - x * x / (r0 * r)) * std::exp(-r / r0), 1e-15);
}

TEST(OscillationVelocity, IsFreeOfDivergence) {
  const double v0 = 0.8, r0 = 0.25e-3, step = 1e-8;
  for (const Vector x :
       {Vector{0.1e-3, 0.05e-3}, Vector{-0.3e-3, 0.2e-3}, Vector{2e-6, -1e-6}, Vector{0.4e-3, -0.1e-3}}) {
    const auto v = [&](double dx, double dy) { return oscillation_velocity(x + Vector{dx, dy}, v0, r0); };
    const double dvx_dx = (v(step, 0).x - v(-step, 0).x) / (2 * step);
    const double dvy_dy = (v(0, step).y - v(0, -step).y) / (2 * step);
    EXPECT_NEAR(dvx_dx + dvy_dy, 0.0, 1e-4 * v0 / r0) << x.x;
    EXPECT_GT(std::abs(dvx_dx), 1e-2 * v0 / r0) << x.x;
  }
}

TEST(OscillationVelocity, IsContinuousAtTheCentre) {
  EXPECT_EQ(oscillation_velocity({0, 0}, 0.8, 0.25e-3), (Vector{}));
  const Vector near = oscillation_velocity({1e-12, 0}, 0.8, 0.25e-3);
  EXPECT_NEAR(near.x, 0.8 * 1e-12 / 0.25e-3, 1e-16);
  EXPECT_EQ(near.y, 0.0);
}

TEST(OscillationVelocity, HasNoMomentum) {
  for (const DropParticles& drop :
       {round_drop_of_rings(radius, d, density).all(), round_drop_of_lattice(radius, d, density).all()}) {
    Vector momentum;
    double magnitude = 0, angular = 0;
    for (std::size_t i = 0; i < drop.masses.size(); ++i) {
      const Vector p = drop.masses[i] * oscillation_velocity(drop.positions[i], 0.8, 0.25e-3);
      momentum += p;
      angular += cross(drop.positions[i], p);
      magnitude += length(p);
    }
    // The innermost ring's three particles do not quite cancel the field's third harmonic.
    EXPECT_LT(length(momentum), 1e-5 * magnitude);
    EXPECT_LT(std::abs(angular), 1e-5 * magnitude * radius);
  }
}

}  // namespace
}  // namespace sphdrop
