// Each process sets up its own share of drop and beam: together they are the whole, and none knows more than its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "config/case_file.hpp"
#include "rigid_body/mass_properties.hpp"
#include "setup/droplet.hpp"
#include "setup/initial_state.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

struct Setting {
  const char *name, *text;
  std::uint64_t positions, velocities, masses;  // hashes from the time when every process built all particles
};

void PrintTo(const Setting& setting, std::ostream* out) {
  *out << setting.name;
}

const Setting settings[] = {
    {"Rings", "[drop]\ndiameter = 1e-3\narrangement = \"rings\"\n", 0xbcd6efc4454bb34f, 0x231a6be7dedbbe2d,
     0x58bcb9029e4a4f04},
    {"Lattice", "[drop]\ndiameter = 1e-3\narrangement = \"lattice\"\njitter = 0\n", 0xe2e7d75fe79c05ad,
     0x1a6802e8b72e58a5, 0x76db47f5c342a025},
    {"JitteredLattice", "[drop]\ndiameter = 1e-3\narrangement = \"lattice\"\njitter = 0.1\nseed = 5\n",
     0xa418feb11fd61f10, 0x1a6802e8b72e58a5, 0x76db47f5c342a025},
    {"Ellipse", "[drop]\ndiameter = 1e-3\nshape = \"ellipse\"\naspect_ratio = 2\njitter = 0.02\n", 0x3e05089d72da0adf,
     0x0e776c8894e67cc5, 0x80e54007fdd301b9},
    {"Square", "[drop]\ndiameter = 1e-3\nshape = \"square\"\njitter = 0.03\n", 0x811a385f3eac9a3a, 0x13f631ef6a6fdd25,
     0xf0890879e04059e5},
    {"RigidSquare",
     "[drop]\ndiameter = 1e-3\nshape = \"square\"\nmaterial = \"rigid\"\ninitial_spin = 100\n"
     "[solid]\nkind = \"rigid_wall\"\n",
     0x5b273fae5b07cea5, 0x694522ba73a40365, 0xf0890879e04059e5},
    {"SeveralDrops",
     "[[drop]]\ndiameter = 1e-3\narrangement = \"rings\"\nvelocity = [1, 0]\n"
     "[[drop]]\ndiameter = 0.7e-3\ncentre_x = 1e-3\nvelocity = [-1, 0.5]\n",
     0xbdf91ec77242e83f, 0x9f2fb326617fd86d, 0x7334c71f2efc2f0c},
    {"OscillatingDropOnABeam",
     "[drop]\ndiameter = 1e-3\noscillation_velocity = 0.2\noscillation_radius = 0.25e-3\n"
     "[solid]\nkind = \"cantilever\"\nlength = 8e-3\n",
     0x80e221dbd026b3c4, 0xf61af59b45ed4807, 0x58bcb9029e4a4f04},
};

Case parse(const std::string& text) {
  return parse_case_text("[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n" + text, "share.cfg").values;
}

std::uint64_t hashed(std::uint64_t hash, double value) {
  return (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
}

std::uint64_t hash_of(const std::vector<Vector>& vectors) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Vector& v : vectors) hash = hashed(hashed(hash, v.x), v.y);
  return hash;
}

std::uint64_t hash_of(const std::vector<double>& values) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const double value : values) hash = hashed(hash, value);
  return hash;
}

void append(const InitialFluid& share, InitialFluid& all) {
  all.positions.insert(all.positions.end(), share.positions.begin(), share.positions.end());
  all.velocities.insert(all.velocities.end(), share.velocities.begin(), share.velocities.end());
  all.masses.insert(all.masses.end(), share.masses.begin(), share.masses.end());
}

void expect_same_of_all(const InitialFluid& a, const InitialFluid& b) {
  EXPECT_EQ(a.total, b.total);
  EXPECT_EQ(a.centre, b.centre);
  EXPECT_EQ(a.bounds.low, b.bounds.low);
  EXPECT_EQ(a.bounds.high, b.bounds.high);
  EXPECT_EQ(a.rest_area, b.rest_area);
  EXPECT_EQ(a.as_body.mass, b.as_body.mass);
  EXPECT_EQ(a.as_body.centre, b.as_body.centre);
  EXPECT_EQ(a.as_body.moment_of_inertia, b.as_body.moment_of_inertia);
}

class Shares : public testing::TestWithParam<Setting> {};

TEST_P(Shares, TogetherAreTheDropBitForBit) {
  const Case input = parse(GetParam().text);
  const InitialState whole = build_initial_state(input);
  EXPECT_EQ(hash_of(whole.fluid.positions), GetParam().positions);
  EXPECT_EQ(hash_of(whole.fluid.velocities), GetParam().velocities);
  EXPECT_EQ(hash_of(whole.fluid.masses), GetParam().masses);
  for (std::int64_t count = 1; count <= 5; ++count) {
    InitialFluid joined;
    for (std::int64_t index = 0; index < count; ++index) {
      const InitialState part = build_initial_state(input, {index, count});
      EXPECT_EQ(part.fluid.first_id, static_cast<std::int64_t>(joined.positions.size()));
      EXPECT_LE(std::abs(part.fluid.ids().count() - whole.fluid.total / count), 1);
      EXPECT_EQ(part.fluid.velocities.size(), part.fluid.positions.size());
      EXPECT_EQ(part.fluid.masses.size(), part.fluid.positions.size());
      expect_same_of_all(part.fluid, whole.fluid);
      EXPECT_EQ(part.solid.total(), whole.solid.total());
      append(part.fluid, joined);
    }
    EXPECT_EQ(hash_of(joined.positions), GetParam().positions) << count;
    EXPECT_EQ(hash_of(joined.velocities), GetParam().velocities) << count;
    EXPECT_EQ(hash_of(joined.masses), GetParam().masses) << count;
  }
}

TEST_P(Shares, KnowWhatBelongsToAllParticles) {
  const Case input = parse(GetParam().text);
  const InitialFluid whole = build_initial_state(input).fluid;
  InitialFluid expected;
  expected.total = static_cast<std::int64_t>(whole.positions.size());
  expected.centre = whole.centre;
  for (const Vector& p : whole.positions) expected.bounds.include(p);
  for (const double mass : whole.masses) expected.rest_area += mass / input.fluid.density;
  if (input.drop.is_rigid()) expected.as_body = mass_properties(whole.positions, whole.masses);
  expect_same_of_all(build_initial_state(input, {2, 3}).fluid, expected);
}

INSTANTIATE_TEST_SUITE_P(OfADrop, Shares, testing::ValuesIn(settings),
                         [](const auto& setting) { return std::string(setting.param.name); });

const std::string fall = "[drop]\ndiameter = 1e-3\n";

class SharesOfABeam : public testing::TestWithParam<const char*> {};

TEST_P(SharesOfABeam, TogetherAreTheBeamBitForBit) {
  const Case input = parse(fall + GetParam());
  const InitialSolid whole = build_initial_state(input).solid;
  ASSERT_EQ(whole.before + whole.after, 0);
  Box bounds;
  for (const Vector& p : whole.positions) bounds.include(p);
  for (std::int64_t count = 1; count <= 5; ++count) {
    InitialSolid joined;
    for (std::int64_t index = 0; index < count; ++index) {
      const InitialSolid part = build_initial_state(input, {index, count}).solid;
      EXPECT_EQ(part.before, static_cast<std::int64_t>(joined.positions.size()));
      EXPECT_EQ(part.total(), whole.total());
      EXPECT_LE(std::abs(part.indices().count() - whole.total() / count), 1);
      EXPECT_EQ(part.bounds.low, bounds.low);
      EXPECT_EQ(part.bounds.high, bounds.high);
      EXPECT_EQ(part.mobile_count, whole.mobile_count);
      EXPECT_EQ(part.deflection_probe, whole.deflection_probe);
      EXPECT_EQ(part.middle_probe, whole.middle_probe);
      EXPECT_EQ(part.contact_polylines, whole.contact_polylines);
      EXPECT_EQ(part.polyline_places, whole.polyline_places);
      EXPECT_EQ(part.columns, whole.columns);
      joined.positions.insert(joined.positions.end(), part.positions.begin(), part.positions.end());
      joined.velocities.insert(joined.velocities.end(), part.velocities.begin(), part.velocities.end());
      joined.masses.insert(joined.masses.end(), part.masses.begin(), part.masses.end());
      joined.is_fixed.insert(joined.is_fixed.end(), part.is_fixed.begin(), part.is_fixed.end());
    }
    EXPECT_EQ(hash_of(joined.positions), hash_of(whole.positions));
    EXPECT_EQ(hash_of(joined.velocities), hash_of(whole.velocities));
    EXPECT_EQ(hash_of(joined.masses), hash_of(whole.masses));
    EXPECT_EQ(joined.is_fixed, whole.is_fixed);
  }
}

TEST_P(SharesOfABeam, KnowWhereItsBoundaryRuns) {
  const Case input = parse(fall + GetParam());
  const InitialSolid whole = build_initial_state(input).solid, part = build_initial_state(input, {1, 3}).solid;
  ASSERT_EQ(part.polyline_places.size(), whole.contact_polylines.size());
  for (std::size_t line = 0; line < whole.contact_polylines.size(); ++line) {
    std::vector<Vector> expected;
    for (const std::int32_t k : whole.contact_polylines[line])
      expected.push_back(whole.positions[static_cast<std::size_t>(k)]);
    EXPECT_EQ(part.polyline_places[line], expected);
  }
  EXPECT_EQ(static_cast<std::size_t>(std::count(whole.is_fixed.begin(), whole.is_fixed.end(), 0)), part.mobile_count);
}

TEST_P(SharesOfABeam, KnowAllColumns) {
  const Case input = parse(fall + GetParam());
  const InitialSolid whole = build_initial_state(input).solid;
  const double spacing = input.resolution.spacing;
  // Rounding to the lattice, from a particle that is known to stand in column 0.
  const auto steps = [&](double from, double to) { return std::floor((to - from) / spacing + 0.5); };
  ASSERT_FALSE(whole.columns.empty());
  std::size_t k = 0;
  double column = 0;
  for (const ColumnStretch& stretch : whole.columns)
    for (std::int64_t c = 0; c < stretch.columns; ++c, ++column)
      for (std::int64_t row = 0; row < stretch.rows(); ++row, ++k) {
        ASSERT_LT(k, whole.positions.size());
        EXPECT_EQ(steps(whole.positions[0].x, whole.positions[k].x), column);
        EXPECT_EQ(steps(whole.positions[0].y, whole.positions[k].y),
                  static_cast<double>(stretch.lowest_row + row - whole.columns.front().lowest_row));
        EXPECT_EQ(whole.is_fixed[k], stretch.is_held[static_cast<std::size_t>(row)]);
      }
  EXPECT_EQ(k, whole.positions.size());
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, SharesOfABeam,
    testing::Values("[solid]\nkind = \"cantilever\"\nlength = 4e-3\ninitial_tip_velocity = 0.1\n",
                    "[solid]\nkind = \"cantilever\"\nlength = 4e-3\nclamp = \"ideal\"\n",
                    "[solid]\nkind = \"fixed_fixed_beam\"\nlength = 4e-3\norigin = [1e-3, 2e-3]\n",
                    "[solid]\nkind = \"fixed_fixed_beam\"\nlength = 4e-3\nformulation = \"total_lagrangian\"\n",
                    "[solid]\nkind = \"cantilever\"\nlength = 4e-3\nformulation = \"cells\"\n",
                    "[solid]\nkind = \"fixed_fixed_beam\"\nlength = 4e-3\nclamp = \"ideal\"\n"
                    "formulation = \"cells\"\norigin = [1e-3, 2e-3]\n"));

// Whose supports are found among all particles is whole on each process.
TEST(SolidThatIsNotShared, IsWhole) {
  for (const char* solid : {"[solid]\nkind = \"cantilever\"\nlength = 4e-3\npinned = [[2e-3, 0]]\n",
                            "[solid]\nkind = \"cantilever\"\nlength = 4e-3\nformulation = \"cells\"\n"
                            "held_in_y = [[2e-3, 0]]\n",
                            "[solid]\nkind = \"cantilever\"\nlength = 4e-3\nprobe = [[2e-3, 0]]\n",
                            "[[solid]]\nkind = \"cantilever\"\nlength = 4e-3\n"
                            "[[solid]]\nkind = \"cantilever\"\nlength = 4e-3\norigin = [0, -3e-3]\n",
                            "[[solid]]\nkind = \"cantilever\"\nlength = 4e-3\nformulation = \"cells\"\n"
                            "[[solid]]\nkind = \"cantilever\"\nlength = 4e-3\nformulation = \"cells\"\n"
                            "origin = [0, -3e-3]\n"}) {
    const Case input = parse(fall + solid);
    const InitialSolid whole = build_initial_state(input).solid, part = build_initial_state(input, {1, 3}).solid;
    EXPECT_EQ(hash_of(part.positions), hash_of(whole.positions));
    EXPECT_EQ(part.before + part.after, 0);
    EXPECT_EQ(part.deflection_probe, whole.deflection_probe);
    EXPECT_EQ(part.holds.size(), whole.holds.size());
  }
}

TEST(ShareOfNothing, IsNothing) {
  const Case input = parse("[drop]\nshape = \"none\"\n[solid]\nkind = \"cantilever\"\nlength = 8e-3\n");
  const InitialFluid fluid = build_initial_state(input, {1, 2}).fluid;
  EXPECT_EQ(fluid.total, 0);
  EXPECT_EQ(fluid.ids().count(), 0);
}

TEST(ShareOfFewParticles, MayBeEmpty) {
  const Case input = parse("[drop]\ndiameter = 1e-4\n");
  std::int64_t sum = 0;
  for (std::int64_t index = 0; index < 50; ++index) sum += build_initial_state(input, {index, 50}).fluid.ids().count();
  EXPECT_EQ(sum, build_initial_state(input).fluid.total);
  EXPECT_LT(sum, 50);
}

std::string refusal(const std::string& text, Share share) {
  try {
    build_initial_state(parse(text), share);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

// Whoever has the particle that is told, all say the same. More of them are in question than are looked at together;
// the messages are those of one look at all of them.
TEST(Refusal, IsThatOfTheWholeDrop) {
  const struct {
    const char *text, *expected;
  } mistakes[] = {
      {"[drop]\nplacement = \"centre\"\ncentre_x = 1e-3\ncentre_y = 0\ndiameter = 8e-3\narrangement = \"lattice\"\n"
       "jitter = 0.1\nseed = 5\n[solid]\nkind = \"obstacle\"\n"
       "polygon = [[-4e-3, -4e-3], [4e-3, -4e-3], [3e-3, 3e-3], [1e-3, -2e-4], [-4e-3, 3e-3]]\n",
       "the particle at x = -0.00153538 m, y = -0.00151101 m is nearer to the solid than the contact distance of "
       "2.5e-05 m "
       "by 0.00248 m"},
      {"[[drop]]\ndiameter = 8e-3\narrangement = \"rings\"\n"
       "[[drop]]\ndiameter = 8e-3\ncentre_x = 5e-3\narrangement = \"lattice\"\njitter = 0.1\nseed = 5\n",
       "the drops 1 and 2 overlap at the start, at x = 0.00100052 m, y = -0.000155305 m;"},
      {"[drop]\ndiameter = 1e-3\ncentre_x = -1e-4\n[solid]\nkind = \"cantilever\"\nlength = 4e-3\n",
       "the particle at x = -8.99258e-05 m, y = 0.000265 m is nearer to the solid than the contact distance of 2.5e-05 "
       "m by "
       "7.25e-05 m"},
      {"[[drop]]\ndiameter = 1e-3\n[[drop]]\ndiameter = 1e-3\ncentre_y = 2e-3\n"
       "[[drop]]\ndiameter = 1e-3\ncentre_y = 1.5e-3\n",
       "the drops 2 and 3 overlap at the start, at x = 1.25e-05 m, y = 0.002 m;"}};
  for (const auto& mistake : mistakes) {
    const std::string whole = refusal(mistake.text, {});
    EXPECT_NE(whole.find(mistake.expected), std::string::npos) << whole;
    EXPECT_EQ(refusal(mistake.text, {0, 4}), whole);
    EXPECT_EQ(refusal(mistake.text, {3, 4}), whole);
  }
}

std::vector<Drop> drops_of_all_shapes() {
  return {round_drop_of_rings(0.5e-3, 2.5e-5, 1000), round_drop_of_lattice(0.5e-3, 2.5e-5, 1000),
          elliptic_drop(0.6e-3, 0.3e-3, 2.5e-5, 1000), square_drop(1e-3, 2.5e-5, 1000),
          round_drop_of_lattice(1e-5, 2.5e-5, 1000)};
}

TEST(WalkThroughADrop, MayBeginAndEndAnywhere) {
  std::vector<Drop> drops = drops_of_all_shapes();
  for (Drop& drop : drops) {
    drop.jitter(2e-6, 3);
    const DropParticles all = drop.all();
    const std::int64_t count = drop.count();
    ASSERT_EQ(static_cast<std::int64_t>(all.positions.size()), count);
    for (std::int64_t first = 0; first <= count; first += 1 + count / 37)
      for (const std::int64_t last : {first, std::min(first + 1, count), std::min(first + 50, count), count}) {
        std::int64_t next = first;
        drop.for_each({first, last}, [&](std::int64_t k, Vector position, double mass) {
          ASSERT_EQ(k, next++);
          ASSERT_EQ(position, all.positions[static_cast<std::size_t>(k)]);
          ASSERT_EQ(mass, all.masses[static_cast<std::size_t>(k)]);
        });
        ASSERT_EQ(next, last);
      }
  }
}

// What is left out as too far away must be: with a jitter that brings particles far from their lines.
TEST(WalkThroughADrop, FindsAllThatAreInABox) {
  std::vector<Drop> drops = drops_of_all_shapes();
  for (Drop& drop : drops) {
    drop.jitter(1e-5, 3);
    Box bounds;
    for (const Vector& p : drop.all().positions) bounds.include(p);
    EXPECT_EQ(drop.bounds().low, bounds.low);
    EXPECT_EQ(drop.bounds().high, bounds.high);
    for (double x = -0.7e-3; x < 0.7e-3; x += 1.1e-4)
      for (double y = -0.7e-3; y < 0.7e-3; y += 1.3e-4) {
        const Box box{{x, y}, {x + 0.9e-4, y + 1.7e-4}};
        std::vector<Vector> found, expected;
        drop.for_each([&](std::int64_t, Vector p, double) {
          if (box.contains(p)) expected.push_back(p);
        });
        drop.for_each_about(box, [&](std::int64_t, Vector p, double) {
          if (box.contains(p)) found.push_back(p);
        });
        ASSERT_EQ(found, expected);
      }
  }
}

TEST(Nearness, IsNeverDeniedWrongly) {
  constexpr double distance = 2e-5;
  std::vector<Drop> drops = drops_of_all_shapes();
  for (Drop& drop : drops) {
    drop.jitter(1e-5, 3);
    const DropParticles all = drop.all();
    int near = 0, far = 0;
    for (double x = -1e-3; x < 1e-3; x += 1.3e-5)
      for (double y = -1e-3; y < 1e-3; y += 1.7e-5) {
        const Vector place{x, y};
        if (drop.is_near(place, distance)) continue;
        ++far;
        for (const Vector& p : all.positions) near += length(p - place) < distance ? 1 : 0;
      }
    EXPECT_EQ(near, 0);
    EXPECT_GT(far, 1000);
  }
}

}  // namespace
}  // namespace sphdrop
