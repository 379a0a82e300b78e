#include "surface_tension/arc_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "drops.hpp"
#include "reference_arcs.hpp"

namespace sphdrop {
namespace {

using namespace test;

struct Found {
  std::vector<Arc> arcs;
  Positions centres;
};

/// Global id = index; only the first `searched` are asked for, if not all.
Found search(ArcSearch& finder, const Positions& positions, std::size_t searched) {
  std::vector<double> x, y;
  for (const Vector position : positions) {
    x.push_back(position.x);
    y.push_back(position.y);
  }
  std::vector<std::int64_t> ids(positions.size());
  std::iota(ids.begin(), ids.end(), 0);
  Found found;
  finder.find(x, y, ids, searched, found.arcs, found.centres);
  return found;
}

void expect_same(const Found& found, std::vector<Arc> expected, const Positions& positions, std::size_t searched) {
  std::erase_if(expected, [&](const Arc& arc) { return arc.particle >= static_cast<std::int64_t>(searched); });
  ASSERT_EQ(found.arcs.size(), expected.size());
  ASSERT_EQ(found.centres.size(), expected.size());
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return found.arcs[a].particle < found.arcs[b].particle; });
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Arc& arc = found.arcs[order[k]];
    EXPECT_EQ(arc.particle, expected[k].particle);
    EXPECT_EQ(arc.previous, expected[k].previous);
    EXPECT_EQ(arc.next, expected[k].next);
    EXPECT_EQ(arc.start, expected[k].start);
    EXPECT_EQ(arc.end, expected[k].end);
    EXPECT_EQ(found.centres[order[k]], positions[static_cast<std::size_t>(arc.particle)]);
  }
}

void expect_arcs_of(const Positions& positions, std::size_t searched) {
  ArcSearch finder(circle_radius);
  const std::vector<Arc> expected = reference_arcs_of(positions);
  expect_same(search(finder, positions, searched), expected, positions, searched);
}

void expect_arcs_of(const Positions& positions) {
  expect_arcs_of(positions, positions.size());
}

// Jittered, so that no two covers end together: which of them is taken then is a matter of ids, not of the search.
TEST(ArcSearch, HasTheBitsOfTheWalkOverAllParticles) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    Positions drop = lattice_disc(9.0 + 0.3 * seed);
    jitter(drop, 0.05 * (seed + 1) * spacing, seed);
    expect_arcs_of(drop);
    Positions holed = lattice(11, 0.0, [](double x, double y) {
      return x * x + y * y < 121 && x * x + y * y > 9 && std::abs(x - 6) + std::abs(y) > 2.5;
    });
    jitter(holed, 0.2 * spacing, seed);
    expect_arcs_of(holed);
    Positions scattered(120);
    jitter(scattered, (4.0 + 4.0 * seed) * spacing, seed);
    expect_arcs_of(scattered);
    Positions apart = together(moved(drop, {0.3, -0.2}), {{-5.0, 7.0}, {-5.0 + spacing, 7.0}, {400.0, 0.0}});
    jitter(apart, 1e-3 * spacing, seed);
    expect_arcs_of(apart);
  }
}

// What is far decides where near neighbours leave a gap: other bodies, thin ones, single particles.
TEST(ArcSearch, FarNeighboursClosePartsOfGaps) {
  std::size_t by_far_ones = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double width = (1.2 + 0.09 * seed) * spacing;
    Positions slit = together(
        rectangle(9, 5), moved(rectangle(9, 3 - static_cast<int>(seed % 3)), {0.37 * spacing, 4.0 * spacing + width}));
    jitter(slit, 0.1 * spacing, seed);
    expect_arcs_of(slit);
    Positions gas(30 + 10 * seed);
    jitter(gas, (8.0 + 0.2 * seed) * spacing, seed);
    expect_arcs_of(gas);
    for (const Positions& positions : {slit, gas})
      for (const Arc& arc : reference_arcs_of(positions))
        if (length(positions[static_cast<std::size_t>(arc.next)] - positions[static_cast<std::size_t>(arc.particle)]) >
            0.8 * circle_radius)
          ++by_far_ones;
  }
  EXPECT_GT(by_far_ones, 1000U);
}

// Several circles meet in one point, on the lattice and across slits where gaps close or are about to.
TEST(ArcSearch, OfSymmetricArrangementsAgreesWithEachByItself) {
  for (int k = 0; k < 60; ++k) {
    const Positions half = rectangle(8, 4);
    const double width = k < 40 ? 0.125 * k : 4.8 + 1e-9 * (k - 50);
    const Positions slit = together(half, moved(half, {k % 2 == 0 ? 0.0 : 0.5 * spacing, (3.0 + width) * spacing}));
    ArcSearch finder(circle_radius);
    expect_same(search(finder, slit, slit.size()), arcs_of(slit), slit, slit.size());
  }
  for (const Positions& positions :
       {ring_disc(9), together(ring_disc(4), moved(ring_disc(4), {9.0 * spacing, 0.0})),
        lattice(9, 0.0, [](double x, double y) { return x * x + y * y < 81 && x * x + y * y > 12; }),
        lattice(9, 0.0,
                [](double x, double y) { return std::abs(x) + std::abs(y) < 9 && std::abs(x) != std::abs(y); })}) {
    ArcSearch finder(circle_radius);
    expect_same(search(finder, positions, positions.size()), arcs_of(positions), positions, positions.size());
  }
}

// The same spoilt by little: circles that met in one point now end about as far apart as directions are told apart,
// those of far neighbours at the ends of gaps between near ones too.
TEST(ArcSearch, OfNearlySymmetricArrangementsAgreesWithEachByItself) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    const double amplitude = std::pow(10.0, -11.0 + 0.04 * seed) * spacing;
    Positions slit = together(rectangle(7, 4), moved(rectangle(7, 4), {0.0, (3.25 + 0.25 * (seed % 17)) * spacing}));
    jitter(slit, amplitude, seed);
    Positions comb =
        lattice(6, 0.0, [&](double x, double y) { return y < 0 || (static_cast<int>(x) % 3 == 0 && y < seed % 5); });
    jitter(comb, amplitude, seed);
    for (const Positions& positions : {slit, comb}) {
      ArcSearch finder(circle_radius);
      expect_same(search(finder, positions, positions.size()), arcs_of(positions), positions, positions.size());
    }
  }
}

TEST(ArcSearch, FindsThemOfThoseSearchedOnly) {
  Positions drop = lattice_disc(8.0);
  jitter(drop, 0.15 * spacing, 3);
  std::shuffle(drop.begin(), drop.end(), std::mt19937(5));
  for (const std::size_t searched : {std::size_t{0}, std::size_t{1}, drop.size() / 2}) expect_arcs_of(drop, searched);
}

TEST(ArcSearch, OfParticlesOnALatticeAgreesWithEachByItself) {
  for (const Positions& positions : {rectangle(12, 9), rectangle(17, 1), rectangle(5, 2), lattice_disc(7.0)}) {
    ArcSearch finder(circle_radius);
    expect_same(search(finder, positions, positions.size()), arcs_of(positions), positions, positions.size());
  }
}

TEST(ArcSearch, OfCoincidentParticlesOnlyTheLowestHasArcs) {
  Positions positions = rectangle(6, 2);
  jitter(positions, 0.1 * spacing, 1);
  for (const std::size_t k : {std::size_t{2}, std::size_t{9}}) positions.push_back(positions[k]);
  expect_arcs_of(positions);
}

TEST(ArcSearch, DoesNotDependOnEarlierUse) {
  ArcSearch finder(circle_radius);
  Positions crowd(400);  // more neighbours than ever
  jitter(crowd, 2.0 * spacing, 1);
  search(finder, crowd, crowd.size());
  Positions drop = lattice_disc(5.0);
  jitter(drop, 0.1 * spacing, 2);
  expect_same(search(finder, drop, drop.size()), reference_arcs_of(drop), drop, drop.size());
}

TEST(ArcSearch, OfNothingFindsNothing) {
  ArcSearch finder(circle_radius);
  EXPECT_TRUE(search(finder, {}, 0).arcs.empty());
}

}  // namespace
}  // namespace sphdrop
