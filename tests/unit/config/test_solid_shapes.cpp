// Solids of any outline, their holds, and several of them: polygons in the file, solid[2].key on the command line.
#include <gtest/gtest.h>

#include "config/case_error.hpp"
#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "config/polygon.hpp"
#include "config/restart_changes.hpp"

namespace sphdrop {
namespace {

const std::string head = "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n";  // lines 1-4
const std::string leaf = head +
                         "[solid]\nkind = \"polygon\"\n"                                                        // 5-6
                         "polygon = [[\"-0.5 mm\", 0], [8e-3, 0],\n  [8e-3, \"0.1 mm\"], [-0.5e-3, 0.4e-3]]\n"  // 7-8
                         "clamps = [[[-1e-3, -1e-3], [0, 1e-3]]]\n";                                            // 9

ParsedCase parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_case_text(text, "leaf.cfg", overrides);
}
Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse(text, overrides).values;
}

std::string mistake_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "none";
}

std::string warnings_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::string all;
  for (const std::string& warning : parse(text, overrides).warnings) all += warning + "\n";
  return all;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Polygon, IsReadWithItsUnits) {
  const Case c = read(leaf);
  ASSERT_EQ(c.solid.polygon.size(), 4U);
  EXPECT_EQ(c.solid.polygon[0], (Point{-0.5e-3, 0}));
  EXPECT_EQ(c.solid.polygon[2], (Point{8e-3, 0.1e-3}));
  ASSERT_EQ(c.solid.clamps.size(), 1U);
  EXPECT_EQ(c.solid.clamps[0][1], (Point{0, 1e-3}));
  EXPECT_DOUBLE_EQ(c.solid.length, 8.5e-3);
  EXPECT_EQ(c.solid.clamp, Clamp::ideal);
  EXPECT_DOUBLE_EQ(c.drop.centre_x, 3.75e-3);
  EXPECT_TRUE(c.has_elastic_solid());
}

TEST(Polygon, IsWrittenSoThatItReadsTheSame) {
  std::string points;
  for (int k = 0; k < 2000; ++k) points.append("[").append(std::to_string(k)).append("e-5, 0.0],\n");
  const Case many = read(head + "[solid]\nkind = \"polygon\"\npolygon = [\n" + points + "[1e-3, 1e-3]]\n");
  EXPECT_EQ(many.solid.polygon.size(), 2001U);
  for (const Case& c : {read(leaf), many}) EXPECT_EQ(read(effective_case_text(c)), c);
}

TEST(Polygon, MistakesNameTheLine) {
  EXPECT_TRUE(holds(mistake_of(head + "[solid]\nkind = \"polygon\"\npolygon = [[0, 0], [1, 0, 0]]\n"),
                    "leaf.cfg:7: solid.polygon must hold points, each [x, y], but point 2 is an array of 3"));
  EXPECT_TRUE(holds(mistake_of(head + "[solid]\nkind = \"polygon\"\npolygon = [[0, 0], [1e-3, \"1 s\"], [0, 1]]\n"),
                    "leaf.cfg:7: solid.polygon (y of point 2)"));
  EXPECT_TRUE(holds(mistake_of(head + "[solid]\nkind = \"polygon\"\npolygon = 3\n"), "must be an array of points"));
  EXPECT_TRUE(holds(mistake_of(head + "[solid]\nkind = \"polygon\"\n"), "solid.polygon is missing"));
  EXPECT_TRUE(holds(mistake_of(leaf, {"solid.clamps=[[[0, 0]]]"}), "(region 1) must be a list of at least two points"));
  EXPECT_TRUE(holds(mistake_of(leaf, {"solid.clamps=[[[0, 0], [0, 1]]]"}), "region 1 is a box without area"));
  EXPECT_TRUE(
      holds(mistake_of(leaf, {"solid.clamps=[[[0, 0], [1, 1], [1, 0], [0, 1]]]"}), "crosses or touches itself"));
  EXPECT_TRUE(holds(mistake_of(leaf, {"resolution.spacing=0.2e-3"}), "thick in the mean, less than 2 spacings"));
}

TEST(Polygon, MustBeSimple) {
  const Points bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, back{{0, 0}, {2, 0}, {1, 0}, {1, 1}},
      twice{{0, 0}, {0, 0}, {1, 0}, {1, 1}};
  const Points touching{{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}, good{{0, 0}, {4, 0}, {4, 2}, {2, 0.5}, {0, 2}};
  EXPECT_TRUE(holds(polygon_mistake(bow).value_or(""), "crosses or touches itself: its side from corner 1 to 2"));
  EXPECT_TRUE(holds(polygon_mistake(back).value_or(""), "turns back on itself at corner 2"));
  EXPECT_TRUE(holds(polygon_mistake(twice).value_or(""), "as corners 1 and 2"));
  EXPECT_TRUE(holds(polygon_mistake(touching).value_or(""), "crosses or touches itself"));
  EXPECT_TRUE(holds(polygon_mistake({{0, 0}, {1, 0}}).value_or(""), "has 2 corners"));
  EXPECT_EQ(polygon_mistake(good), std::nullopt);
  EXPECT_EQ(polygon_mistake({{0, 0}, {1, 0}, {2, 0}, {2, 1}}), std::nullopt);  // a corner within a side is harmless
  EXPECT_DOUBLE_EQ(area_of(bow), 0.0);
  EXPECT_DOUBLE_EQ(area_of(good), 5.0);
  EXPECT_DOUBLE_EQ(perimeter_of({{0, 0}, {3, 0}, {3, 4}}), 12.0);
}

TEST(Polygon, BelongsToItsKinds) {
  const std::string beam = head + "[solid]\nkind = \"cantilever\"\nlength = 8e-3\n";
  EXPECT_TRUE(holds(mistake_of(beam, {"solid.polygon=[[0, 0], [1, 0], [1, 1]]"}), "needs solid.kind = \"polygon\""));
  EXPECT_TRUE(holds(mistake_of(beam, {"solid.clamps=[[[0, 0], [1, 1]]]"}), "has its own (solid.clamp_length)"));
  EXPECT_EQ(mistake_of(beam, {"solid.held_in_y=[[8e-3, 0]]"}), "none");  // a propped cantilever
  EXPECT_TRUE(holds(mistake_of(head + "[solid]\nkind = \"rigid_wall\"\n", {"solid.pinned=[[0, 0]]"}),
                    "solid.pinned needs an elastic solid"));
  EXPECT_TRUE(holds(mistake_of(leaf, {"solid.damping_ratio=0.1"}), "needs a straight beam"));
  EXPECT_EQ(mistake_of(leaf, {"solid.damping_rate=100"}), "none");
  EXPECT_TRUE(holds(warnings_of(leaf, {"solid.clamps=[]"}), "nothing holds the polygon"));
  EXPECT_TRUE(holds(warnings_of(leaf, {"solid.clamps=[]", "solid.held_in_y=[[0, 0], [8e-3, 0]]"}), "nothing holds"));
  EXPECT_FALSE(holds(warnings_of(leaf, {"solid.clamps=[]", "solid.pinned=[[0, 0]]"}), "nothing holds"));
  EXPECT_FALSE(holds(warnings_of(leaf), "nothing holds"));
  EXPECT_FALSE(holds(warnings_of(leaf), "thick in the mean"));
  EXPECT_FALSE(holds(warnings_of(leaf), "oblique to its lattice"));
  EXPECT_TRUE(holds(warnings_of(leaf, {"solid.lattice_direction=[4, 3]"}), "oblique to its lattice"));
  EXPECT_TRUE(holds(mistake_of(leaf, {"solid.lattice_direction=[0, 0]"}), "is no direction"));
  EXPECT_TRUE(holds(warnings_of(leaf, {"resolution.spacing=8e-5"}), "the polygon is 3.03 particles thick"));
}

TEST(Polygon, SetsTheTimeStepAsABeamDoes) {
  const std::string beam = head + "[solid]\nkind = \"cantilever\"\nlength = 8e-3\n";
  EXPECT_EQ(mistake_of(leaf, {"time.step=1e-3"}).substr(mistake_of(leaf, {"time.step=1e-3"}).find("exceeds"), 30),
            mistake_of(beam, {"time.step=1e-3"}).substr(mistake_of(beam, {"time.step=1e-3"}).find("exceeds"), 30));
  EXPECT_EQ(read(leaf, {"mode=modern"}).solid.formulation, SolidFormulation::cells);
}

const std::string two = "mode = \"modern\"\n" + head +
                        "[[solid]]\nkind = \"cantilever\"\nlength = 8e-3\n"                               // 6-8
                        "[[solid]]\nkind = \"obstacle\"\npolygon = [[1, 1], [1.1, 1], [1, 1.1]]\n"        // 9-11
                        "[[solid]]\nkind = \"cantilever\"\nlength = 4e-3\nyoungs_modulus = \"30 MPa\"\n"  // 12-15
                        "origin = [0, -0.1]\n";                                                           // 16

TEST(SeveralSolids, AreReadInTheirOrder) {
  const Case c = read(two);
  ASSERT_EQ(c.solid_count(), 3U);
  EXPECT_EQ(c.solid_at(1).kind, SolidKind::obstacle);
  EXPECT_EQ(c.solid_at(2).youngs_modulus, 30e6);
  EXPECT_EQ(c.solid_at(2).origin_y, -0.1);
  EXPECT_EQ(c.solid_at(2).formulation, SolidFormulation::cells);
  EXPECT_EQ(c.solid_at(2).clamp, Clamp::ideal);  // mode modern's, for each
  EXPECT_EQ(c.with_solid(2).solid.length, 4e-3);
  EXPECT_TRUE(c.with_solid(2).more_solids.empty());
  EXPECT_EQ(read(effective_case_text(c)), c);
}

TEST(SeveralSolids, OverridesNameTheSolid) {
  const Case c = read(two, {"solid[3].length=2e-3", "solid[1].length=\"9 mm\"", "solid.density=900"});
  EXPECT_EQ(c.solid_at(2).length, 2e-3);
  EXPECT_EQ(c.solid.length, 9e-3);
  EXPECT_EQ(c.solid.density, 900);
  EXPECT_EQ(c.solid_at(2).density, 1000);
  EXPECT_TRUE(
      holds(mistake_of(two, {"solid[4].length=1"}), "the case has 3 solids; each further one is a section [[solid]]"));
  EXPECT_TRUE(holds(mistake_of(two, {"fluid[2].density=1"}), "not a known key"));
}

TEST(SeveralSolids, MistakesNameLineAndSolid) {
  EXPECT_TRUE(holds(mistake_of(two + "density = -1\n"), "leaf.cfg:17: solid[3].density = -1 is out of range"));
  const std::string thin = mistake_of(two, {"solid[3].thickness=0.26e-3"});
  EXPECT_TRUE(holds(thin, "solid 3: solid.thickness = ")) << thin;
  EXPECT_TRUE(holds(thin, "solid[3].thickness: --set")) << thin;
  EXPECT_TRUE(holds(mistake_of(two, {"solid[2].kind=none"}), "solid 2 of 3 has solid.kind = \"none\""));
  EXPECT_TRUE(holds(mistake_of(two, {"mode=paper"}), "solid 3 is of another material"));
  EXPECT_EQ(mistake_of(two, {"mode=paper", "solid[3].youngs_modulus=300e6"}), "none");
  EXPECT_TRUE(holds(mistake_of(two, {"solid[3].formulation=hypoelastic"}), "need the same solid.formulation"));
}

TEST(SeveralSolids, AreDoubtedWhereTheyMayMeet) {
  EXPECT_FALSE(holds(warnings_of(two), "may meet"));
  EXPECT_TRUE(holds(warnings_of(two, {"solid[3].origin=[0, -2e-3]"}), "the solids 1 and 3 are so near"));
}

TEST(SeveralSolids, AreComparedAtARestart) {
  const auto changes = parameter_changes(read(two), read(two, {"solid[3].density=900"}));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].key, "solid[3].density");
  EXPECT_FALSE(parameter_changes(read(two), read(leaf)).empty());
}

}  // namespace
}  // namespace sphdrop
