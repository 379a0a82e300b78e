// Bodies of any outline as particles.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "setup/lattice_filling.hpp"
#include "setup/polygon_geometry.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

constexpr double d = 2.5e-5;

std::vector<Vector> turned(std::vector<Vector> polygon, double cosine, double sine, Vector shift) {
  for (Vector& p : polygon) p = Vector{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y} + shift;
  return polygon;
}

PlaneMoments moments_of_filling(const LatticeFilling& filling) {
  PlaneMoments sum;
  for (std::size_t k = 0; k < filling.column.size(); ++k)
    for (const PlaneMoments& quadrant : filling.quadrants[k])
      sum += moments_about(quadrant, -filling.position(k).x, -filling.position(k).y);
  return sum;
}

void expect_filled(const std::vector<Vector>& polygon) {
  const LatticeFilling filling = fill_with_lattice(polygon, d);
  const PlaneMoments found = moments_of_filling(filling), wanted = moments_of(polygon, {0, 0});
  const double scale = wanted.area;
  EXPECT_NEAR(found.area / scale, 1.0, 1e-9);
  EXPECT_NEAR(found.first_x, wanted.first_x, 1e-9 * scale * 40);
  EXPECT_NEAR(found.first_y, wanted.first_y, 1e-9 * scale * 40);
  EXPECT_NEAR(found.second_x, wanted.second_x, 1e-9 * scale * 1600);
  EXPECT_NEAR(found.second_y, wanted.second_y, 1e-9 * scale * 1600);
  for (std::size_t k = 0; k < filling.column.size(); ++k) {
    EXPECT_EQ(filling.at(filling.column[k], filling.row[k]), static_cast<std::int32_t>(k));
    EXPECT_GE(filling.area(k), 0.25 - 1e-6);
  }
}

TEST(LatticeFilling, HasAreaAndMomentsOfThePolygon) {
  const std::vector<Vector> bar{{0, 0}, {30, 0}, {30, 6}, {0, 6}};
  expect_filled(bar);
  expect_filled(turned(bar, 0.6, 0.8, {0.3, -0.2}));
  expect_filled(turned(bar, 0.8, -0.6, {-0.1, 0.7}));
  expect_filled({{0, -6}, {40, -1.5}, {40, 1.5}, {0, 6}});                       // a taper
  expect_filled({{0, 0}, {30, 0}, {30, 8}, {17, 8}, {15, 3}, {13, 8}, {0, 8}});  // a notch
}

TEST(LatticeFilling, OfARectangleOnTheLatticeIsTheLattice) {
  const LatticeFilling filling = fill_with_lattice(std::vector<Vector>{{-3, 2}, {5, 2}, {5, 6}, {-3, 6}}, d);
  ASSERT_EQ(filling.column.size(), 32U);
  EXPECT_EQ(filling.position(0), (Vector{-2.5, 2.5}));
  EXPECT_EQ(filling.position(31), (Vector{4.5, 5.5}));
  for (std::size_t k = 0; k < 32; ++k) {
    EXPECT_EQ(filling.area(k), 1.0);
    EXPECT_EQ(filling.quadrants[k], filling.quadrants[0]);
  }
}

std::string refusal(const std::vector<Vector>& polygon) {
  try {
    fill_with_lattice(polygon, 1e-3);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

TEST(LatticeFilling, RefusesWhatIsTooThin) {
  EXPECT_NE(refusal({{0, 0}, {20, 0}, {20, 1.2}, {0, 1.2}}).find("no 2 x 2 particles fit"), std::string::npos);
  // Two plates on a neck of one particle, and the place is told.
  const std::string neck = refusal(
      {{0, 0}, {8, 0}, {8, 3}, {12, 3}, {12, 0}, {20, 0}, {20, 8}, {12, 8}, {12, 4.2}, {8, 4.2}, {8, 8}, {0, 8}});
  EXPECT_NE(neck.find("does not hold together"), std::string::npos);
  EXPECT_NE(neck.find("x = 0.0125 m"), std::string::npos) << neck;
  // A needle's point.
  EXPECT_NE(refusal({{0, -3}, {60, 0}, {0, 3}}).find("no particle stands within 4 spacings"), std::string::npos);
  EXPECT_EQ(refusal({{0, -8}, {20, 0}, {0, 8}}), "");
}

const std::string leaf =
    "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\nshape = \"none\"\n[solid]\nkind = \"polygon\"\n"
    "polygon = [[-0.25e-3, -0.2e-3], [3e-3, -0.07e-3], [3e-3, 0.05e-3], [-0.25e-3, 0.2e-3]]\n"
    "clamps = [[[-1, -1], [0, 1]]]\n";

InitialState build(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return build_initial_state(parse_case_text(text, "leaf.cfg", overrides).values);
}

TEST(PolygonBody, HasTheMassOfItsArea) {
  const InitialSolid body = build(leaf).solid;
  EXPECT_NEAR(std::accumulate(body.masses.begin(), body.masses.end(), 0.0), 1000 * 3.25e-3 * 0.26e-3, 1e-12);
  for (std::size_t k = 0; k < body.positions.size(); ++k) EXPECT_EQ(body.is_fixed[k] != 0, body.positions[k].x < 0);
  // Watched is the free end.
  ASSERT_EQ(body.deflection_probe.size(), 1U);
  EXPECT_NEAR(body.positions[static_cast<std::size_t>(body.deflection_probe[0])].x, 3e-3 - d / 2, 1e-9);
}

// The surface that a drop meets is d/2 outside the contact line.
TEST(PolygonBody, HasAContactLineAlongTheOutline) {
  const InitialSolid body = build(leaf).solid;
  ASSERT_EQ(body.contact_polylines.size(), 1U);
  EXPECT_EQ(body.contact_polylines[0].front(), body.contact_polylines[0].back());
  std::vector<Vector> line;
  for (const ContactVertex& vertex : body.contact_vertices) {
    Vector place;
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(vertex.count); ++k) {
      place += vertex.weight[k] * body.positions[static_cast<std::size_t>(vertex.particle[k])];
      sum += vertex.weight[k];
      EXPECT_LE(std::abs(vertex.weight[k]), 2.25);
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    // In a corner the cells may not reach quite so far.
    EXPECT_NEAR(distance_to_border(body.outline, place), d / 2, place.x > 2.95e-3 ? 0.3 * d : 1e-9 * d);
    EXPECT_TRUE(contains(body.outline, place));
    line.push_back(place);
  }
  EXPECT_LT(signed_area(line), 0.0);  // the solid is on the right
  EXPECT_NEAR(-signed_area(line) / (3.25e-3 * 0.26e-3), 1.0, 0.12);
}

TEST(PolygonBody, IsHeldWhereTheCaseSays) {
  const InitialSolid body =
      build(leaf, {"solid.clamps=[]", "solid.pinned=[[0, 0]]", "solid.held_in_y=[[3e-3, 0], [1e-3, 0.4e-3]]",
                   "solid.probe=[[1.5e-3, 0], [1.6e-3, 0]]", "solid.held_in_y=[[2.9e-3, 0]]",
                   "solid.held_in_x=[[2.9e-3, 0]]"})
          .solid;
  ASSERT_EQ(body.holds.size(), 2U);
  EXPECT_TRUE(body.holds[0].in_x && body.holds[0].in_y);
  EXPECT_TRUE(body.holds[1].in_x && body.holds[1].in_y);  // by two keys
  EXPECT_LE(length(body.positions[static_cast<std::size_t>(body.holds[0].particle)]), d);
  EXPECT_EQ(body.deflection_probe.size(), 2U);
  EXPECT_EQ(body.mobile_count, body.positions.size());
  EXPECT_THROW(build(leaf, {"solid.pinned=[[1e-3, 0.4e-3]]"}), SetupError);
  EXPECT_THROW(build(leaf, {"solid.clamps=[[[5e-3, 0], [6e-3, 1]]]"}), SetupError);
  EXPECT_THROW(build(leaf, {"solid.clamps=[[[-1, -1], [1, 1]]]"}), SetupError);
}

TEST(PolygonBody, HasItsLatticeWhereTheCaseSays) {
  const InitialSolid body = build(leaf, {"solid.lattice_direction=[30, -1]"}).solid;
  EXPECT_NEAR(std::accumulate(body.masses.begin(), body.masses.end(), 0.0), 1000 * 3.25e-3 * 0.26e-3, 1e-12);
  const Vector rows = unit(Vector{30, -1});
  const Vector step = body.positions[1] - body.positions[0];
  EXPECT_NEAR(dot(step, rows), 0.0, 1e-12);  // up a column
  EXPECT_NEAR(length(step), d, 1e-12);
  for (const Vector& p : body.positions)
    EXPECT_TRUE(distance_to_border(body.outline, p) < d || contains(body.outline, p));
}

TEST(Obstacle, IsItsBorder) {
  const InitialSolid body =
      build(
          "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\ngap = 1e-5\ncentre_x = 0.2e-3\n"
          "diameter = 0.4e-3\n[solid]\nkind = \"obstacle\"\n"
          "polygon = [[0, 0], [1e-3, 0.2e-3], [0.3e-3, 0.7e-3]]\n")
          .solid;
  for (const Vector& p : body.positions) EXPECT_NEAR(distance_to_border(body.outline, p), d / 2, 1e-9 * d);
  for (std::size_t k = 0; k < body.positions.size(); ++k) {
    EXPECT_EQ(body.is_fixed[k], 1);
    EXPECT_LE(length(body.positions[(k + 1) % body.positions.size()] - body.positions[k]), d * (1 + 1e-9));
  }
  EXPECT_THROW(build("[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\ncentre_x = 0.5e-3\n[solid]\nkind = "
                     "\"obstacle\"\npolygon = [[0, 0], [1e-3, 0], [1e-3, 1e-3], [0.5e-3, 0.01e-3], [0, 1e-3]]\n"),
               SetupError);
}

const std::string two_solids =
    "mode = \"modern\"\n[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\ndiameter = 0.5e-3\ncentre_x = "
    "1e-3\n"
    "[[solid]]\nkind = \"cantilever\"\nlength = 2e-3\n"
    "[[solid]]\nkind = \"cantilever\"\nlength = 1e-3\norigin = [0.5e-3, -1e-3]\ndensity = 2000\n";

TEST(SeveralSolids, StandInTheirOrderAndPlace) {
  const InitialState state = build(two_solids);
  ASSERT_EQ(state.solid.bodies.size(), 2U);
  const InitialSolid::Body &one = state.solid.bodies[0], &other = state.solid.bodies[1];
  EXPECT_EQ(one.end, other.begin);
  EXPECT_EQ(static_cast<std::size_t>(other.end), state.solid.positions.size());
  EXPECT_EQ(state.solid.masses.back(), 2000 * d * d);
  for (const std::int32_t k : other.deflection_probe) {
    EXPECT_GE(k, other.begin);
    EXPECT_NEAR(state.solid.positions[static_cast<std::size_t>(k)].x, 1.5e-3 - d / 2, 1e-12);
  }
  // The drop is above the upper one.
  double lowest = 1;
  for (const Vector& p : state.fluid.positions) lowest = std::min(lowest, p.y);
  EXPECT_NEAR(lowest, 0.25e-3 + 0.6 * d, 1e-9);
  EXPECT_EQ(build(two_solids, {"drop.centre_x=-5e-3", "drop.placement=centre", "drop.centre_y=1e-3"}).drop_centre.y,
            1e-3);
  EXPECT_THROW(build(two_solids, {"drop.centre_x=5e-3"}), SetupError);
}

TEST(SeveralSolids, MustBeApart) {
  EXPECT_THROW(build(two_solids, {"solid[2].origin=[0.5e-3, -0.1e-3]"}), SetupError);
  EXPECT_THROW(
      build(two_solids, {"solid[2].origin=[2.02e-3, 0.1e-3]", "solid[2].kind=rigid_wall", "solid[2].length=0.1e-3"}),
      SetupError);
}

// On a slope the distance is that of the nearest particle.
TEST(PolygonBody, HasADropAtItsGap) {
  const InitialState state =
      build(leaf, {"drop.shape=round", "drop.diameter=0.5e-3", "drop.centre_x=1.5e-3", "drop.gap=0.05e-3"});
  double nearest = 1;
  for (const Vector& p : state.fluid.positions) nearest = std::min(nearest, distance_to_border(state.solid.outline, p));
  EXPECT_NEAR(nearest, 0.05e-3 + d / 2, 1e-9);
}

}  // namespace
}  // namespace sphdrop
