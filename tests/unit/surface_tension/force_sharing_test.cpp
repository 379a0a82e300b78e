#include "surface_tension/force_sharing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include "drops.hpp"
#include "surface_tension/surface_force.hpp"
#include "surface_tension/surface_points.hpp"

namespace sphdrop {
namespace {

using namespace test;

constexpr double reach = 2.0 * smoothing_length + 0.5 * spacing + 0.1 * spacing;

struct Drop {
  SurfaceCurves curves;
  Positions nodes, points, forces;
  std::vector<double> x, y, masses, acceleration_x, acceleration_y;

  explicit Drop(const Positions& positions) : curves(curves_of(positions)) {
    nodes = node_positions(curves, positions);
    points.resize(nodes.size());
    forces.resize(nodes.size());
    surface_points(curves, nodes, spacing, points);
    conservative_forces(curves, points, 0.072, forces);
    for (const Vector position : positions) {
      x.push_back(position.x);
      y.push_back(position.y);
      masses.push_back(6e-7 * (1.0 + 0.01 * static_cast<double>(x.size() % 7)));
    }
    acceleration_x.assign(x.size(), 0.0);
    acceleration_y.assign(x.size(), 0.0);
  }

  Positions positions() const {
    Positions result;
    for (std::size_t i = 0; i < x.size(); ++i) result.push_back({x[i], y[i]});
    return result;
  }
  /// With the particles in ascending order, if no other is given.
  void rebuild(ForceSharing& sharing, std::vector<std::int32_t> order = {}) const {
    if (order.empty()) {
      order.resize(x.size());
      std::iota(order.begin(), order.end(), 0);
    }
    sharing.rebuild(nodes, positions(), order, reach);
  }
  std::size_t share(ForceSharing& sharing) {
    Positions ended = positions();
    ended.push_back(ForceSharing::far_away);
    const std::span<const Vector> shares = sharing.share(points, forces, ended, CubicSpline(smoothing_length));
    EXPECT_EQ(shares.size(), x.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
      acceleration_x[i] += shares[i].x * (1.0 / masses[i]);
      acceleration_y[i] += shares[i].y * (1.0 / masses[i]);
    }
    return sharing.points_without_particles();
  }
};

/// Eqs 32 and 33 over all particles, in scalar arithmetic and the order promised.
void share_over_all(Drop& drop) {
  const CubicSpline kernel(smoothing_length);
  std::vector<Vector> shares(drop.x.size());
  for (std::size_t k = 0; k < drop.points.size(); ++k) {
    std::vector<double> weights;
    double sum = 0.0;
    for (std::size_t i = 0; i < drop.x.size(); ++i) {
      const Vector separation = drop.points[k] - Vector{drop.x[i], drop.y[i]};
      weights.push_back(kernel.value(length(separation)));
      sum += weights.back();
    }
    if (sum == 0.0) continue;
    for (std::size_t i = 0; i < drop.x.size(); ++i) {
      shares[i].x += drop.forces[k].x / sum * weights[i];
      shares[i].y += drop.forces[k].y / sum * weights[i];
    }
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    drop.acceleration_x[i] += shares[i].x * (1.0 / drop.masses[i]);
    drop.acceleration_y[i] += shares[i].y * (1.0 / drop.masses[i]);
  }
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

Positions jittered_disc(double radius, unsigned seed) {
  Positions positions = lattice_disc(radius);
  jitter(positions, 0.2 * spacing, seed);
  return positions;
}

TEST(ForceSharing, HasTheBitsOfTheScalarSumOverAllParticles) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    // The surface of one drop passes through the origin, where an unset position would be; another drop is far away.
    const double radius = 4.0 + seed;
    Drop drop(together(moved(jittered_disc(radius, seed), {radius * spacing, 0.0}),
                       moved(jittered_disc(3.0, seed), {1.0, -2.0})));
    Drop expected = drop;
    share_over_all(expected);
    ForceSharing sharing;
    drop.rebuild(sharing);
    EXPECT_EQ(drop.share(sharing), 0U);
    EXPECT_TRUE(same_bits(drop.acceleration_x, expected.acceleration_x)) << seed;
    EXPECT_TRUE(same_bits(drop.acceleration_y, expected.acceleration_y)) << seed;
  }
}

TEST(ForceSharing, GivesTheWholeForceToTheParticles) {
  Drop drop(jittered_disc(15.0, 4));
  for (std::size_t k = 0; k < drop.forces.size(); ++k) drop.forces[k] += {1e-3, 2e-3};  // so that the sum is not zero
  ForceSharing sharing;
  drop.rebuild(sharing);
  drop.share(sharing);
  Vector given, received;
  double size = 0.0;
  for (const Vector force : drop.forces) {
    given += force;
    size += length(force);
  }
  for (std::size_t i = 0; i < drop.x.size(); ++i)
    received += drop.masses[i] * Vector{drop.acceleration_x[i], drop.acceleration_y[i]};
  EXPECT_GT(length(given), 0.01 * size);
  EXPECT_LT(length(given - received), 1e-15 * size);
}

TEST(ForceSharing, HoldsUntilParticlesHaveMovedThroughTheMargin) {
  Positions positions = jittered_disc(10.0, 6);
  Drop before(positions);
  ForceSharing sharing;
  before.rebuild(sharing);

  jitter(positions, 0.03 * spacing, 60);  // twice this is within the margin
  Drop after = before;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    after.x[i] = positions[i].x;
    after.y[i] = positions[i].y;
  }
  after.nodes = node_positions(after.curves, positions);
  surface_points(after.curves, after.nodes, spacing, after.points);
  Drop expected = after;
  after.share(sharing);
  share_over_all(expected);
  EXPECT_TRUE(same_bits(after.acceleration_x, expected.acceleration_x));
  EXPECT_FALSE(same_bits(after.acceleration_x, before.acceleration_x));
}

TEST(ForceSharing, DependsOnTheOrderGivenAndNotOnWhereParticlesLie) {
  Drop drop(jittered_disc(9.0, 8));
  Drop expected = drop;
  share_over_all(expected);
  // They lie shuffled; in the order given they are as they were.
  std::vector<std::int32_t> place(drop.x.size());
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), std::mt19937(3));
  const Drop sorted = drop;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto k = static_cast<std::size_t>(place[i]);
    drop.x[k] = sorted.x[i];
    drop.y[k] = sorted.y[i];
    drop.masses[k] = sorted.masses[i];
  }
  ForceSharing sharing;
  drop.rebuild(sharing, place);
  drop.share(sharing);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto k = static_cast<std::size_t>(place[i]);
    EXPECT_EQ(drop.acceleration_x[k], expected.acceleration_x[i]) << i;
    EXPECT_EQ(drop.acceleration_y[k], expected.acceleration_y[i]) << i;
  }
  Drop other = sorted;
  std::reverse(place.begin(), place.end());
  other.rebuild(sharing, place);
  other.share(sharing);
  EXPECT_FALSE(same_bits(other.acceleration_x, expected.acceleration_x));
}

TEST(ForceSharing, DoesNotDependOnEarlierUse) {
  ForceSharing used;
  Drop large(jittered_disc(12.0, 1));
  large.rebuild(used);
  large.share(used);
  Drop drop(jittered_disc(5.0, 2));
  Drop expected = drop;
  drop.rebuild(used);
  drop.share(used);
  share_over_all(expected);
  EXPECT_TRUE(same_bits(drop.acceleration_x, expected.acceleration_x));
}

TEST(ForceSharing, CountsPointsWithoutParticles) {
  Drop drop(jittered_disc(6.0, 3));
  for (std::size_t k = 0; k < drop.points.size(); ++k)
    if (k != 5) drop.forces[k] = {};
  drop.points[5] = {1.0, 1.0};
  ForceSharing sharing;
  drop.rebuild(sharing);
  EXPECT_EQ(drop.share(sharing), 1U);
  for (const double a : drop.acceleration_x) EXPECT_EQ(a, 0.0);
}

TEST(ForceSharing, OfNothingDoesNothing) {
  ForceSharing sharing;
  Drop drop(Positions{});
  drop.rebuild(sharing);
  EXPECT_EQ(drop.share(sharing), 0U);
}

// A particle at the edge of the reach, which was moved within the kernel's support, counts; one beyond does not.
TEST(ForceSharing, GoesByTheReachAtRebuilding) {
  const std::vector<Vector> points{{0.5, -0.5}};
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 16;
    const Vector direction = {std::cos(angle), std::sin(angle)};
    for (const double distance : {(1.0 - 1e-6) * reach, (1.0 + 1e-6) * reach}) {
      const Vector then = points[0] + distance * direction, now = points[0] + spacing * direction;
      ForceSharing sharing;
      sharing.rebuild(points, Positions{then}, std::vector<std::int32_t>{0}, reach);
      const Positions ended{now, ForceSharing::far_away};
      const std::span<const Vector> shares =
          sharing.share(points, Positions{{1.0, 2.0}}, ended, CubicSpline(smoothing_length));
      EXPECT_NEAR(shares[0].y, distance < reach ? 2.0 : 0.0, 1e-15) << k;
    }
  }
}

}  // namespace
}  // namespace sphdrop
