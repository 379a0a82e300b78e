#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "setup/beam.hpp"
#include "setup/setup_error.hpp"

namespace sphdrop {
namespace {

constexpr double d = 0.025e-3;

/// 32 columns by 10 rows, clamps of 20 columns and 3 layers.
Case::Solid short_beam(SolidKind kind) {
  Case::Solid solid;
  solid.kind = kind;
  solid.length = 0.8e-3;
  solid.thickness = 0.25e-3;
  solid.density = 1000;
  solid.clamp_length = 0.5e-3;
  solid.clamp_layers = 3;
  return solid;
}

std::vector<Vector> line_of(const InitialSolid& solid, std::size_t polyline) {
  std::vector<Vector> line;
  for (const std::int32_t i : solid.contact_polylines.at(polyline)) line.push_back(solid.positions.at(i));
  return line;
}

/// Every step of the walk leads to a neighbour on the lattice, with solid on its right and none on its left; only in a
/// concave corner does one of the two sites on the left belong to the solid.
void expect_walk_with_the_solid_on_the_right(const InitialSolid& solid, const std::vector<Vector>& line) {
  const auto is_solid = [&](Vector x) {
    return std::any_of(solid.positions.begin(), solid.positions.end(),
                       [&](Vector p) { return length(p - x) < 0.1 * d; });
  };
  int concave_steps = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Vector step = line[k + 1] - line[k];
    EXPECT_NEAR(length(step), d, 1e-9 * d) << k;
    const bool first = is_solid(line[k] + left_normal(step)), second = is_solid(line[k + 1] + left_normal(step));
    EXPECT_FALSE(first && second) << k;
    if (first || second) ++concave_steps;
    EXPECT_TRUE(is_solid(line[k] + right_normal(step))) << k;
    EXPECT_TRUE(is_solid(line[k + 1] + right_normal(step))) << k;
  }
  EXPECT_EQ(concave_steps, 4);  // before and after each of the two corners
}

std::string message_of(const Case::Solid& solid, double spacing) {
  try {
    build_beam(solid, spacing);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

TEST(Cantilever, HasItsLatticeAndItsClamp) {
  const InitialSolid beam = build_beam(short_beam(SolidKind::cantilever), d);
  ASSERT_EQ(beam.positions.size(), 32u * 10 + 20u * 16);
  EXPECT_EQ(beam.mobile_count, 52u * 10);
  EXPECT_NEAR(beam.top, 0.25e-3, 1e-15);
  double highest_fixed_x = -1, lowest_mobile_y = 1, highest_mobile_y = -1, lowest_fixed_y = 1, highest_fixed_y = -1;
  for (std::size_t i = 0; i < beam.positions.size(); ++i) {
    const Vector x = beam.positions[i];
    EXPECT_EQ(beam.masses[i], 1000 * d * d);
    EXPECT_EQ(beam.velocities[i], Vector{});
    const bool is_beside_the_beam = x.y < 0 || x.y > 0.25e-3;
    EXPECT_EQ(beam.is_fixed[i] != 0, is_beside_the_beam);
    if (beam.is_fixed[i]) {
      highest_fixed_x = std::max(highest_fixed_x, x.x);
      lowest_fixed_y = std::min(lowest_fixed_y, x.y);
      highest_fixed_y = std::max(highest_fixed_y, x.y);
    } else {
      lowest_mobile_y = std::min(lowest_mobile_y, x.y);
      highest_mobile_y = std::max(highest_mobile_y, x.y);
    }
  }
  EXPECT_NEAR(highest_fixed_x, -0.5 * d, 1e-9 * d);
  EXPECT_NEAR(lowest_mobile_y, 0.5 * d, 1e-9 * d);
  EXPECT_NEAR(highest_mobile_y, 9.5 * d, 1e-9 * d);
  EXPECT_NEAR(lowest_fixed_y, -2.5 * d, 1e-9 * d);
  EXPECT_NEAR(highest_fixed_y, 12.5 * d, 1e-9 * d);
  EXPECT_NEAR(beam.positions.front().x, -19.5 * d, 1e-9 * d);
  EXPECT_NEAR(beam.positions.back().x, 31.5 * d, 1e-9 * d);
}

TEST(Cantilever, InAnIdealClampIsHeldItselfAndHasNoStrips) {
  Case::Solid solid = short_beam(SolidKind::cantilever);
  solid.clamp = Clamp::ideal;
  const InitialSolid beam = build_beam(solid, d);
  ASSERT_EQ(beam.positions.size(), (20u + 32u) * 10u);
  EXPECT_EQ(beam.mobile_count, 32u * 10u);
  for (std::size_t k = 0; k < beam.positions.size(); ++k)
    EXPECT_EQ(beam.is_fixed[k] != 0, beam.positions[k].x < 0) << k;
  // Over the top, down the free end and back along the underside, without a corner between.
  const std::vector<Vector> line = line_of(beam, 0);
  ASSERT_EQ(line.size(), 2u * 52u + 8u);
  for (std::size_t k = 1; k < line.size(); ++k) EXPECT_NEAR(length(line[k] - line[k - 1]), d, 1e-9 * d) << k;
  EXPECT_EQ(line.front().x, line.back().x);
}

TEST(Cantilever, StandsInLatticeOrder) {
  for (const SolidKind kind : {SolidKind::cantilever, SolidKind::fixed_fixed_beam}) {
    const InitialSolid beam = build_beam(short_beam(kind), d);
    for (std::size_t i = 0; i + 1 < beam.positions.size(); ++i) {
      const Vector a = beam.positions[i], b = beam.positions[i + 1];
      EXPECT_TRUE(b.x > a.x || (b.x == a.x && std::abs(b.y - a.y - d) < 1e-9 * d)) << i;
    }
  }
}

TEST(Cantilever, IsProbedAtItsLastColumn) {
  const InitialSolid beam = build_beam(short_beam(SolidKind::cantilever), d);
  ASSERT_EQ(beam.deflection_probe.size(), 10u);
  EXPECT_TRUE(std::is_sorted(beam.deflection_probe.begin(), beam.deflection_probe.end()));
  for (const std::int32_t i : beam.deflection_probe) EXPECT_NEAR(beam.positions.at(i).x, 31.5 * d, 1e-9 * d);
}

TEST(Cantilever, HasItsMiddleProbeAtMidSpan) {
  Case::Solid solid = short_beam(SolidKind::cantilever);
  const InitialSolid even = build_beam(solid, d);
  ASSERT_EQ(even.middle_probe.size(), 20u);
  EXPECT_TRUE(std::is_sorted(even.middle_probe.begin(), even.middle_probe.end()));
  for (const std::int32_t i : even.middle_probe)
    EXPECT_NEAR(std::abs(even.positions.at(i).x - 16 * d), 0.5 * d, 1e-9 * d);
  solid.length = 31 * d;
  const InitialSolid odd = build_beam(solid, d);
  ASSERT_EQ(odd.middle_probe.size(), 10u);
  for (const std::int32_t i : odd.middle_probe) EXPECT_NEAR(odd.positions.at(i).x, 15.5 * d, 1e-9 * d);
}

TEST(Cantilever, HasOneBoundaryRoundItsFreeEnd) {
  const InitialSolid beam = build_beam(short_beam(SolidKind::cantilever), d);
  ASSERT_EQ(beam.contact_polylines.size(), 1u);
  const std::vector<Vector> line = line_of(beam, 0);
  // Twice: strip, its face (3 steps to the beam), free part; and the free end.
  ASSERT_EQ(line.size(), 2u * (20 + 3 + 32) + 8u);
  expect_walk_with_the_solid_on_the_right(beam, line);
  EXPECT_NEAR(line.front().x, -19.5 * d, 1e-9 * d);
  EXPECT_NEAR(line.front().y, 12.5 * d, 1e-9 * d);
  EXPECT_NEAR(line.back().x, -19.5 * d, 1e-9 * d);
  EXPECT_NEAR(line.back().y, -2.5 * d, 1e-9 * d);
  // Concave corners where the strips end, convex ones at the free end.
  EXPECT_NEAR(line[22].x, -0.5 * d, 1e-9 * d);
  EXPECT_NEAR(line[22].y, 9.5 * d, 1e-9 * d);
  EXPECT_NEAR(line[54].x, 31.5 * d, 1e-9 * d);
  EXPECT_NEAR(line[54].y, 9.5 * d, 1e-9 * d);
  EXPECT_NEAR(line[63].x, 31.5 * d, 1e-9 * d);
  EXPECT_NEAR(line[63].y, 0.5 * d, 1e-9 * d);
}

TEST(Cantilever, BoundaryOfATwoRowBeamVisitsNoParticleTwice) {
  Case::Solid solid = short_beam(SolidKind::cantilever);
  solid.thickness = 2 * d;
  const InitialSolid beam = build_beam(solid, d);
  std::vector<std::int32_t> line = beam.contact_polylines.at(0);
  expect_walk_with_the_solid_on_the_right(beam, line_of(beam, 0));
  std::sort(line.begin(), line.end());
  EXPECT_EQ(std::adjacent_find(line.begin(), line.end()), line.end());
}

TEST(FixedFixedBeam, IsSymmetricAboutItsMiddle) {
  const InitialSolid beam = build_beam(short_beam(SolidKind::fixed_fixed_beam), d);
  ASSERT_EQ(beam.positions.size(), 32u * 10 + 2 * 20u * 16);
  EXPECT_EQ(beam.mobile_count, 72u * 10);
  for (std::size_t i = 0; i < beam.positions.size(); ++i) {
    const std::size_t image = beam.positions.size() - 1 - i;
    EXPECT_NEAR(beam.positions[i].x + beam.positions[image].x, 0.8e-3, 1e-15);
    EXPECT_NEAR(beam.positions[i].y + beam.positions[image].y, 0.25e-3, 1e-15);
    EXPECT_EQ(beam.is_fixed[i], beam.is_fixed[image]);
  }
}

TEST(FixedFixedBeam, HasItsTopAndItsUndersideAsBoundary) {
  const InitialSolid beam = build_beam(short_beam(SolidKind::fixed_fixed_beam), d);
  ASSERT_EQ(beam.contact_polylines.size(), 2u);
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<Vector> line = line_of(beam, side);
    ASSERT_EQ(line.size(), 2u * (20 + 3) + 32u);
    expect_walk_with_the_solid_on_the_right(beam, line);
    EXPECT_EQ(line.front().x < line.back().x, side == 0);
    EXPECT_EQ(line.front().y > 0, side == 0);
    EXPECT_EQ(line.front().y, line.back().y);
  }
}

TEST(FixedFixedBeam, IsProbedInTheMiddle) {
  Case::Solid solid = short_beam(SolidKind::fixed_fixed_beam);
  const auto mean_x = [](const InitialSolid& beam) {
    double sum = 0;
    for (const std::int32_t i : beam.deflection_probe) sum += beam.positions.at(i).x;
    return sum / static_cast<double>(beam.deflection_probe.size());
  };
  const InitialSolid even = build_beam(solid, d);
  EXPECT_EQ(even.deflection_probe.size(), 20u);
  EXPECT_NEAR(mean_x(even), 0.4e-3, 1e-12);
  EXPECT_EQ(even.middle_probe, even.deflection_probe);
  solid.length = 31 * d;
  const InitialSolid odd = build_beam(solid, d);
  EXPECT_EQ(odd.deflection_probe.size(), 10u);
  EXPECT_NEAR(mean_x(odd), 15.5 * d, 1e-12);
  for (const InitialSolid* beam : {&even, &odd})
    for (const std::int32_t i : beam->deflection_probe) EXPECT_FALSE(beam->is_fixed[i]);
}

TEST(RigidWall, IsOneFixedRowUnderItsSurface) {
  Case::Solid solid;
  solid.kind = SolidKind::rigid_wall;
  solid.length = 4e-3;
  solid.density = 1000;
  const InitialSolid wall = build_rigid_wall(solid, d);
  ASSERT_EQ(wall.positions.size(), 160u);
  EXPECT_EQ(wall.mobile_count, 0u);
  EXPECT_EQ(wall.top, 0.0);
  EXPECT_TRUE(wall.deflection_probe.empty());
  EXPECT_TRUE(wall.middle_probe.empty());
  for (std::size_t i = 0; i < wall.positions.size(); ++i) {
    EXPECT_EQ(wall.positions[i].y, -0.5 * d);
    EXPECT_EQ(wall.positions[i].x, -wall.positions[wall.positions.size() - 1 - i].x);
    EXPECT_TRUE(wall.is_fixed[i]);
  }
  EXPECT_NEAR(wall.positions.back().x, 2e-3 - 0.5 * d, 1e-15);
  ASSERT_EQ(wall.contact_polylines.size(), 1u);
  const std::vector<Vector> line = line_of(wall, 0);
  ASSERT_EQ(line.size(), 160u);
  for (std::size_t k = 0; k + 1 < line.size(); ++k) EXPECT_NEAR(line[k + 1].x - line[k].x, d, 1e-9 * d);
}

TEST(BendingMode, HasTheTabulatedShape) {
  EXPECT_NEAR(first_cantilever_mode(0.0), 0.0, 1e-15);
  EXPECT_EQ(first_cantilever_mode(1.0), 1.0);
  // Blevins, Formulas for Natural Frequency and Mode Shape, Table 8-1, over the value 2 at the free end.
  EXPECT_NEAR(first_cantilever_mode(0.2), 0.12774 / 2, 1e-5);
  EXPECT_NEAR(first_cantilever_mode(0.5), 0.67905 / 2, 1e-5);
  EXPECT_NEAR(first_cantilever_mode(0.8), 1.45096 / 2, 1e-5);
}

TEST(BendingMode, MeetsItsBoundaryConditions) {
  const double step = 1e-3;
  const auto phi = [](double x) { return first_cantilever_mode(x); };
  EXPECT_NEAR((phi(step) - phi(-step)) / (2 * step), 0.0, 1e-5);                           // clamped: no slope
  EXPECT_NEAR((phi(1 + step) - 2 * phi(1.0) + phi(1 - step)) / (step * step), 0.0, 1e-4);  // free: no moment
  EXPECT_NEAR((phi(1.1) - 3 * phi(1.05) + 3 * phi(1.0) - phi(0.95)) / 1.25e-4, 0.0, 0.4);  // no shear, at 1.025
  const double third_at_root =
      (phi(0.15) - 3 * phi(0.1) + 3 * phi(0.05) - phi(0.0)) / 1.25e-4;  // there it is -2 s b^3/2
  EXPECT_NEAR(third_at_root, -0.7341 * std::pow(1.8751, 3), 0.05);
}

TEST(BendingMode, SetsTheFreePartMoving) {
  Case::Solid solid = short_beam(SolidKind::cantilever);
  solid.initial_tip_velocity = -0.3;
  const InitialSolid beam = build_beam(solid, d);
  for (std::size_t i = 0; i < beam.positions.size(); ++i) {
    EXPECT_EQ(beam.velocities[i].x, 0.0);
    const double fraction = beam.positions[i].x / 0.8e-3;
    const double expected = fraction < 0 ? 0.0 : -0.3 * first_cantilever_mode(fraction);
    EXPECT_NEAR(beam.velocities[i].y, expected, 1e-12);
  }
  EXPECT_LT(beam.velocities.back().y, -0.28);
}

TEST(BuildBeam, RefusesWhatDoesNotFitItsLattice) {
  Case::Solid solid = short_beam(SolidKind::cantilever);
  EXPECT_NE(message_of(solid, 0.0417e-3).find("length of 0.0008 m is 19.18"), std::string::npos)
      << message_of(solid, 0.0417e-3);
  solid.length = 20 * 0.0417e-3;
  EXPECT_NE(message_of(solid, 0.0417e-3).find("4.166666667e-05"), std::string::npos) << message_of(solid, 0.0417e-3);
  solid = short_beam(SolidKind::cantilever);
  solid.length = 20 * 0.25e-3 / 6;
  EXPECT_EQ(message_of(solid, 0.25e-3 / 6), "");
  EXPECT_EQ(message_of(solid, 0.0416667e-3), "");
}

TEST(BuildBeam, RefusesABeamThatIsTooThinOrLoose) {
  Case::Solid solid = short_beam(SolidKind::cantilever);
  solid.length = 1e-3;
  EXPECT_NE(message_of(solid, 0.25e-3).find("at least 2 rows"), std::string::npos) << message_of(solid, 0.25e-3);
  solid.clamp_layers = 0;
  EXPECT_NE(message_of(solid, d).find("nothing would hold the beam"), std::string::npos);
  solid = short_beam(SolidKind::fixed_fixed_beam);
  solid.clamp_length = 0.3 * d;
  EXPECT_NE(message_of(solid, d).find("nothing would hold the beam"), std::string::npos);
}

TEST(BuildBeam, RefusesATipVelocityWithoutAFreeTip) {
  Case::Solid solid = short_beam(SolidKind::fixed_fixed_beam);
  solid.initial_tip_velocity = 1;
  EXPECT_NE(message_of(solid, d).find("needs a cantilever"), std::string::npos);
  solid.kind = SolidKind::rigid_wall;
  EXPECT_THROW(build_rigid_wall(solid, d), SetupError);
}

}  // namespace
}  // namespace sphdrop
