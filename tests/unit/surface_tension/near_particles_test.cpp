#include "surface_tension/near_particles.hpp"

#include <gtest/gtest.h>

#include "drops.hpp"

namespace sphdrop {
namespace {

using namespace test;

std::vector<std::int32_t> found(const Positions& points, const Positions& particles, double reach) {
  std::vector<double> x, y;
  for (const Vector particle : particles) {
    x.push_back(particle.x);
    y.push_back(particle.y);
  }
  return particles_near(points, x, y, reach);
}

std::vector<std::int32_t> expected(const Positions& points, const Positions& particles, double reach) {
  std::vector<std::int32_t> near;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    bool is_near = false;
    for (const Vector point : points) is_near = is_near || squared_length(point - particles[i]) <= reach * reach;
    if (is_near) near.push_back(static_cast<std::int32_t>(i));
  }
  return near;
}

TEST(NearParticles, AreThoseThatAnyPointReaches) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Positions particles = lattice_disc(3.0 + 0.5 * seed);
    jitter(particles, 0.3 * spacing, seed);
    if (seed % 2 == 1) std::shuffle(particles.begin(), particles.end(), std::mt19937(seed));
    Positions points = ellipse((3.0 + 0.5 * seed) * spacing, 4.0 * spacing, 60);
    points.push_back({1.0, -2.0});  // where no particle is
    for (const double reach : {0.7 * spacing, 2.5 * spacing, 6.0 * spacing}) {
      const std::vector<std::int32_t> near = found(points, particles, reach);
      EXPECT_FALSE(near.empty());
      EXPECT_EQ(near, expected(points, particles, reach)) << seed << ' ' << reach;
    }
  }
}

TEST(NearParticles, AtTheEdgeOfTheReachCount) {
  const double reach = 4.0 * spacing;
  EXPECT_EQ(found({{0.0, 0.0}}, {{reach, 0.0}, {0.0, -reach}, {1.0001 * reach, 0.0}, {-reach, 0.0}}, reach),
            (std::vector<std::int32_t>{0, 1, 3}));
}

TEST(NearParticles, OfNoPointsAreNone) {
  EXPECT_TRUE(found({}, lattice_disc(3.0), spacing).empty());
  EXPECT_TRUE(found({{0.0, 0.0}}, {}, spacing).empty());
}

}  // namespace
}  // namespace sphdrop
