// Drops whose particles a file gives.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "config/case_error.hpp"
#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "setup/given_drop.hpp"
#include "setup/initial_state.hpp"
#include "setup/nearest_neighbour.hpp"
#include "setup/setup_error.hpp"
#include "setup/split_mix.hpp"

namespace sphdrop {
namespace {

constexpr double d = 2.5e-5;

/// A lattice of n x n at `spacing` with its lower left particle at `corner`, m.
GivenParticles square(int n, double spacing = d, Vector corner = {}) {
  GivenParticles given;
  given.file = "drop.csv";
  given.path = "/somewhere/drop.csv";
  given.checksum = "0123456789abcdef0123456789abcdef";
  for (int k = 0; k < n * n; ++k) {
    given.x.push_back(corner.x + (k / n) * spacing);
    given.y.push_back(corner.y + (k % n) * spacing);
    given.lines.push_back(k + 2);
  }
  return given;
}

ParsedCase parse(const GivenParticles& given, const std::string& drop = "", const std::string& rest = "",
                 const std::vector<std::string>& overrides = {}) {
  const std::string text =
      "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\nparticles_file = \"drop.csv\"\n";
  return parse_case_text(text + drop + rest, "folder/pair.cfg", overrides, [&](const ParticleRequest& request) {
    EXPECT_EQ(request.path, "folder/drop.csv");
    return std::make_shared<const GivenParticles>(given);
  });
}

InitialState build(const GivenParticles& given, const std::string& drop = "", const std::string& rest = "") {
  return build_initial_state(parse(given, drop, rest).values);
}

template <class Error>
std::string mistake_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

std::string set_up_mistake(const GivenParticles& given, const std::string& drop = "", const std::string& rest = "") {
  return mistake_of<SetupError>([&] { build(given, drop, rest); });
}

std::string case_mistake(const GivenParticles& given, const std::string& drop) {
  return mistake_of<CaseError>([&] { parse(given, drop); });
}

TEST(GivenDrop, StaysWhereItsFileHasIt) {
  const GivenParticles given = square(10, d, {0.3e-3, 0.7e-3});
  const InitialState state = build(given, "velocity = [1, 2]\n");
  ASSERT_EQ(state.fluid.positions.size(), given.size());
  for (std::size_t k = 0; k < given.size(); ++k) {
    EXPECT_EQ(state.fluid.positions[k], (Vector{given.x[k], given.y[k]}));
    EXPECT_EQ(state.fluid.velocities[k], (Vector{1, 2}));
    EXPECT_DOUBLE_EQ(state.fluid.masses[k], 1000 * d * d);
  }
  EXPECT_NEAR(state.drop_centre.x, 0.3e-3 + 4.5 * d, 1e-18);
  EXPECT_NEAR(state.drop_centre.y, 0.7e-3 + 4.5 * d, 1e-18);
  EXPECT_TRUE(state.warnings.empty());
}

TEST(GivenDrop, IsPlacedByWhateverPlacesOthers) {
  const GivenParticles given = square(10, d, {0.3e-3, 0.7e-3});
  const auto centre = [](const InitialState& state) {
    Vector sum;
    for (const Vector& p : state.fluid.positions) sum += (1.0 / static_cast<double>(state.fluid.positions.size())) * p;
    return sum;
  };
  const Vector moved = centre(build(given, "centre_x = 1e-3\ncentre_y = -2e-3\n"));
  EXPECT_NEAR(moved.x, 1e-3, 1e-15);
  EXPECT_NEAR(moved.y, -2e-3, 1e-15);
  const InitialState above = build(given, "centre_x = 0\n", "[solid]\nkind = \"rigid_wall\"\n");
  EXPECT_NEAR(centre(above).x, 0, 1e-15);
  double lowest = 1;
  for (const Vector& p : above.fluid.positions) lowest = std::min(lowest, p.y);
  EXPECT_NEAR(lowest, 0.5 * d + 0.1 * d, 1e-15);  // the default gap
  EXPECT_EQ(centre(build(given, "placement = \"above_solid\"\n", "[solid]\nkind = \"rigid_wall\"\n")), centre(above));
  EXPECT_NE(case_mistake(given, "placement = \"file\"\ncentre_x = 0\n").find("drop.centre_x moves the drop, and"),
            std::string::npos);
}

TEST(GivenDrop, HasTheDiameterOfTheCircleOfItsArea) {
  const GivenParticles given = square(20);
  EXPECT_DOUBLE_EQ(parse(given).values.drop.diameter, std::sqrt(4 / std::numbers::pi * 400 * d * d));
  GivenParticles heavy = given;
  heavy.mass.assign(400, 1.05 * 1000 * d * d);
  EXPECT_NEAR(parse(heavy).values.drop.diameter, std::sqrt(4 / std::numbers::pi * 400 * 1.05 * d * d), 1e-16);
  EXPECT_EQ(build(heavy).fluid.masses, heavy.mass);
  // Given, it is the drop's, whose mass the particles share.
  const InitialState state = build(given, "diameter = 0.57e-3\n");
  EXPECT_NEAR(std::accumulate(state.fluid.masses.begin(), state.fluid.masses.end(), 0.0),
              1000 * std::numbers::pi / 4 * 0.57e-3 * 0.57e-3, 1e-15);
}

TEST(GivenDrop, HasTheMassesOfAnEllipseOfTheSameParticles) {
  const std::string text =
      "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\nshape = \"ellipse\"\naspect_ratio = 4\n";
  const InitialFluid ellipse = build_initial_state(parse_case_text(text, "a.cfg").values).fluid;
  GivenParticles given = square(1);
  given.x.clear(), given.y.clear(), given.lines.clear();
  for (const Vector& p : ellipse.positions) given.x.push_back(p.x), given.y.push_back(p.y);
  const InitialFluid own = build(given, "diameter = 1e-3\n").fluid;
  EXPECT_EQ(own.positions, ellipse.positions);
  EXPECT_EQ(own.masses, ellipse.masses);
  EXPECT_EQ(own.velocities, ellipse.velocities);
}

TEST(GivenDrop, AddsItsVelocitiesToTheDrops) {
  GivenParticles given = square(10);
  for (std::size_t k = 0; k < given.size(); ++k) {
    given.velocity_x.push_back(0.01 * static_cast<double>(k));
    given.velocity_y.push_back(-1);
  }
  const InitialState state = build(given, "velocity = [1, 2]\n");
  EXPECT_EQ(state.fluid.velocities[3], (Vector{1 + 0.03, 1}));
  EXPECT_NE(case_mistake(given, "relaxation_time = 1e-3\n").find("drop.csv has velocities"), std::string::npos);
  EXPECT_NE(case_mistake(given, "material = \"rigid\"\n").find("drop.csv has velocities"), std::string::npos);
  // What flies faster goes farther.
  EXPECT_GT(parse(given).values.safety.domain_margin, parse(square(10)).values.safety.domain_margin + 1e-3);
}

TEST(GivenDrop, MayBeRigid) {
  const InitialState state = build(square(10), "material = \"rigid\"\ndensity = 2000\ninitial_spin = 10\n");
  EXPECT_DOUBLE_EQ(state.fluid.masses[0], 2000 * d * d);
  EXPECT_NEAR(state.fluid.velocities[0].x, 10 * 4.5 * d, 1e-15);
}

TEST(GivenDrop, IsOneOfSeveral) {
  const std::string text =
      "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[[drop]]\ndiameter = 0.5e-3\n"
      "[[drop]]\nparticles_file = \"b.csv\"\n[[drop]]\nparticles_file = \"/c.csv\"\n";
  std::vector<std::string> asked;
  const ParticleReader read = [&](const ParticleRequest& request) {
    asked.push_back(request.path + " " + std::to_string(request.drop) + " " + request.results_directory);
    return std::make_shared<const GivenParticles>(square(10, d, {static_cast<double>(request.drop) * 1e-3, 0}));
  };
  const Case input = parse_case_text(text, "runs/three.cfg", {}, read).values;
  EXPECT_EQ(asked, (std::vector<std::string>{"runs/b.csv 1 results/three", "/c.csv 2 results/three"}));
  const InitialState state = build_initial_state(input);
  const std::size_t round = state.fluid.positions.size() - 200;
  EXPECT_EQ(state.fluid.positions[round], (Vector{1e-3, 0}));
  EXPECT_EQ(state.fluid.positions[round + 100], (Vector{2e-3, 0}));
}

TEST(GivenDrop, TheEffectiveCaseRepeatsItOrSaysThatTheFileIsAnother) {
  const GivenParticles given = square(10, d, {0.3e-3, 0.7e-3});
  const Case input = parse(given, "velocity = [0, 1]\n", "[solid]\nkind = \"rigid_wall\"\n").values;
  GivenParticles there = given;
  const auto again = [&] {
    return parse_case_text(effective_case_text(input), "results/case.cfg", {}, [&](const ParticleRequest& request) {
      EXPECT_EQ(request.path, "/somewhere/drop.csv");
      return std::make_shared<const GivenParticles>(there);
    });
  };
  EXPECT_EQ(again().values, input);
  EXPECT_EQ(parse_case_text(effective_case_text(input), "results/case.cfg").values, input)
      << "without reading the file";
  there.checksum = "another";
  EXPECT_NE(mistake_of<CaseError>(again).find("the file has changed since"), std::string::npos);
}

TEST(GivenDrop, MistakesOfTheReaderAreToldWithBothPlaces) {
  const auto said = [](const ParticleFileError& error) {
    return mistake_of<CaseError>([&] {
      parse_case_text("[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\nparticles_file = \"b.csv\"\n",
                      "a.cfg", {},
                      [&](const ParticleRequest&) -> std::shared_ptr<const GivenParticles> { throw error; });
    });
  };
  EXPECT_EQ(said({"cannot be read: gone", false}),
            "a.cfg:6: drop.particles_file = \"b.csv\" cannot be read: gone\n    6 | particles_file = \"b.csv\"");
  EXPECT_EQ(said({"b.csv:3: is odd", true}), "b.csv:3: is odd (drop.particles_file: a.cfg:6)");
}

TEST(GivenDrop, ContradictionsAreRefused) {
  const GivenParticles given = square(10);
  EXPECT_NE(case_mistake(given, "shape = \"round\"\n").find("leave out drop.shape, or the file"), std::string::npos);
  EXPECT_NE(
      case_mistake(given, "diameter = 1e-3\n").find("and the 100 particles of drop.csv have 6.25e-08 m2 together"),
      std::string::npos);
  const auto without = [](const std::string& drop) {
    return mistake_of<CaseError>(
        [&] { parse_case_text("[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\n" + drop, "a.cfg"); });
  };
  EXPECT_NE(without("shape = \"particles\"\n").find("needs drop.particles_file"), std::string::npos);
  EXPECT_NE(without("placement = \"file\"\n").find("needs drop.particles_file"), std::string::npos);
  EXPECT_NE(without("particles_checksum = \"1\"\n").find("there is no drop.particles_file"), std::string::npos);
}

TEST(GivenDrop, OtherSpacingsAreRefused) {
  EXPECT_EQ(set_up_mistake(square(10, 0.8 * d)), "none");
  EXPECT_NE(set_up_mistake(square(10, 0.7 * d)).find("resolution.spacing = 1.75e-05 m"), std::string::npos);
  EXPECT_NE(set_up_mistake(square(10, 1.3 * d)).find("which does not fit resolution.spacing = 2.5e-05 m"),
            std::string::npos);
  EXPECT_NE(
      set_up_mistake(square(10, 1e3 * d)).find("are its lengths in mm? Then say so in its first line: x [mm], y [mm]"),
      std::string::npos);
  EXPECT_NE(set_up_mistake(square(10, 1e6 * d)).find("are its lengths in um?"), std::string::npos);
}

TEST(GivenDrop, TwinsAreNamedByTheirLines) {
  GivenParticles given = square(10);
  given.x[50] = given.x[20] + 0.2 * d;
  given.y[50] = given.y[20];
  EXPECT_EQ(
      set_up_mistake(given).find("drop.csv:52: the particle at x = 5.5e-05 m, y = 0 m is only 5e-06 m from that of "
                                 "line 22; particles must be at least half"),
      0u)
      << set_up_mistake(given);
  given.lines.clear();
  EXPECT_EQ(set_up_mistake(given).find("drop.csv: row 50: the particle"), 0u) << set_up_mistake(given);
}

TEST(GivenDrop, MassesMustFitTheSpacing) {
  GivenParticles given = square(10);
  given.mass.assign(100, 1000 * d * d);
  EXPECT_EQ(set_up_mistake(given), "none");
  given.mass[7] *= 2.5;
  EXPECT_EQ(set_up_mistake(given).find("drop.csv:9: a mass of 1.5625e-06 kg/m does not fit"), 0u)
      << set_up_mistake(given);
  given.mass.assign(100, 1.2 * 1000 * d * d);
  EXPECT_NE(case_mistake(given, "").find("the masses of drop.csv are 7.5e-07 kg/m in the mean"), std::string::npos)
      << case_mistake(given, "");
}

TEST(GivenDrop, InTheSolidIsRefused) {
  const std::string said =
      set_up_mistake(square(10, d, {0, -3 * d}), "", "[solid]\nkind = \"rigid_wall\"\nlength = 8e-3\n");
  EXPECT_NE(said.find("the drop overlaps the solid at the start"), std::string::npos) << said;
  EXPECT_NE(said.find("in its file"), std::string::npos) << said;
}

TEST(GivenDrop, PiecesAreDoubted) {
  GivenParticles given = square(10);
  const GivenParticles apart = square(10, d, {9 * d + 2.5 * d, 0});
  for (std::size_t k = 0; k < apart.size(); ++k) {
    given.x.push_back(apart.x[k]), given.y.push_back(apart.y[k]);
    given.lines.push_back(static_cast<std::int64_t>(given.lines.size()) + 2);
  }
  const InitialState state = build(given);
  ASSERT_EQ(state.warnings.size(), 1u);
  EXPECT_EQ(
      state.warnings[0].find("drop.csv:102: here begins another piece: the particles of drop.csv are in 2 pieces"), 0u)
      << state.warnings[0];
  for (std::size_t k = 100; k < 200; ++k) given.x[k] -= 0.3 * d;
  EXPECT_TRUE(build(given).warnings.empty()) << "2.2 spacings are within the kernel's reach";
}

TEST(NearestNeighbours, AreWhatComparingAllFinds) {
  SplitMix64 random(7);
  for (const double stretch : {1.0, 1e-9, 0.0}) {
    std::vector<Vector> points;
    for (int k = 0; k < 500; ++k) points.push_back({random.next_symmetric(), stretch * random.next_symmetric()});
    for (int k = 0; k < 50; ++k) points.push_back(points[static_cast<std::size_t>(3 * k)]);  // clumps
    points.push_back({1e6, -1e6});                                                           // a stray
    const NearestNeighbours found = nearest_neighbours(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < points.size(); ++j)
        if (j != k) nearest = std::min(nearest, length(points[k] - points[j]));
      ASSERT_EQ(found.distance[k], nearest) << k;
      ASSERT_NE(found.index[k], static_cast<std::int32_t>(k));
      ASSERT_EQ(length(points[k] - points[static_cast<std::size_t>(found.index[k])]), nearest);
    }
  }
}

TEST(NearestNeighbours, AreNoneOfOnePoint) {
  const NearestNeighbours found = nearest_neighbours(std::vector<Vector>{{1, 2}});
  EXPECT_EQ(found.index, std::vector<std::int32_t>{-1});
  EXPECT_TRUE(std::isinf(median_distance(found)));
  EXPECT_EQ(median_distance({{1, 0, 0, 0}, {3, 1, 2, 9}}), 3);
}

}  // namespace
}  // namespace sphdrop
