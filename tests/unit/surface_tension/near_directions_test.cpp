#include "surface_tension/near_directions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "drops.hpp"
#include "particles/pack.hpp"

namespace sphdrop {
namespace {

using namespace test;

bool is_inside(const Positions& positions, std::size_t i) {
  NearDirections<double> directions(circle_radius);
  for (const Vector position : positions) directions.add(position.x - positions[i].x, position.y - positions[i].y);
  return directions.cover();
}

/// How deep the shallowest of sampled points of particle i's circle lies inside another's, m; negative if it is outside
/// of all.
double least_depth(const Positions& positions, std::size_t i, int samples) {
  double least = circle_radius;
  for (int k = 0; k < samples; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / samples;
    const Vector point = positions[i] + circle_radius * Vector{std::cos(angle), std::sin(angle)};
    double depth = -1.0;
    for (std::size_t j = 0; j < positions.size(); ++j)
      if (j != i) depth = std::max(depth, circle_radius - length(point - positions[j]));
    least = std::min(least, depth);
  }
  return least;
}

TEST(NearDirections, SortOutTheInteriorAndNoBoundaryParticle) {
  const Positions lattice_places = lattice_disc(10.0);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Positions positions = lattice_places;
    jitter(positions, 0.01 * seed * spacing, seed);
    std::set<std::int64_t> on_boundary;
    for (const Arc& arc : arcs_of(positions)) on_boundary.insert(arc.particle);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const bool inside = is_inside(positions, i);
      EXPECT_FALSE(inside && on_boundary.contains(static_cast<std::int64_t>(i))) << i;
      if (length(lattice_places[i]) < 8.0 * spacing) {
        EXPECT_TRUE(inside) << i;
      }
    }
  }
}

TEST(NearDirections, AreNeverMistaken) {
  // Few neighbours at random, so that gaps of every width occur.
  int inside = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    Positions positions(9);
    jitter(positions, 1.5 * spacing, seed);
    positions[0] = {};
    if (!is_inside(positions, 0)) continue;
    ++inside;
    EXPECT_GT(least_depth(positions, 0, 90), 0.0) << seed;
  }
  EXPECT_GT(inside, 300);
}

TEST(NearDirections, HoldForTheWidestGapsTheyAccept) {
  // Every other octant holds a neighbour, and of two gaps one is nearly three octants wide.
  for (const double distance : {0.1, 0.5, 0.76}) {
    Positions positions = {{0.0, 0.0}};
    for (const double degrees : {0.1, 134.9, 180.1, 314.9}) {
      const double angle = degrees * std::numbers::pi / 180.0;
      positions.push_back(distance * circle_radius * Vector{std::cos(angle), std::sin(angle)});
    }
    EXPECT_TRUE(is_inside(positions, 0));
    EXPECT_GT(least_depth(positions, 0, 720), 0.0) << distance;
    for (Vector& position : positions) position = (0.77 / distance) * position;
    EXPECT_FALSE(is_inside(positions, 0));
  }
}

TEST(NearDirections, NeedEveryQuadrant) {
  // Twelve directions all round; without those of one quadrant a gap of 120 degrees is left.
  for (int empty = 0; empty < 12; ++empty) {
    Positions positions = {{0.0, 0.0}};
    for (int k = 0; k < 12; ++k) {
      const double angle = (30.0 * k + 10.0) * std::numbers::pi / 180.0;
      if ((k - empty + 12) % 12 >= 4) positions.push_back(spacing * Vector{std::cos(angle), std::sin(angle)});
    }
    EXPECT_FALSE(is_inside(positions, 0)) << empty;
  }
}

TEST(NearDirections, AreTheSameInEveryLane) {
  constexpr auto lanes = static_cast<std::size_t>(pack_size);
  for (unsigned seed = 0; seed < 200; ++seed) {
    Positions positions(12);
    jitter(positions, 1.5 * spacing, seed);
    const auto place = [&](auto lane) { return positions[static_cast<std::size_t>(lane)]; };
    const Pack x([&](auto lane) { return place(lane).x; }), y([&](auto lane) { return place(lane).y; });
    NearDirections<Pack> directions(circle_radius);
    for (const Vector position : positions) directions.add(position.x - x, position.y - y);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      EXPECT_EQ(directions.cover(lane), is_inside(positions, lane)) << seed;
  }
}

}  // namespace
}  // namespace sphdrop
