// Drops whose particles a file gives: the same bits on any number of ranks, those of a built-in drop with the same
// particles, and a swing that keeps the area.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "particles/elementary_functions.hpp"
#include "tests/support/equal_states.hpp"

namespace sphdrop {
namespace {

using test::WholeState;

constexpr double spacing = 0.05e-3;  // m

/// R(1 + 0.3 cos 2 theta) of the square lattice, R = 0.3 mm, with a spin of its own.
std::shared_ptr<const GivenParticles> peanut(const ParticleRequest& request) {
  auto given = std::make_shared<GivenParticles>();
  given->file = given->path = request.path;
  given->checksum = "0";
  for (int column = -20; column < 20; ++column)
    for (int row = -20; row < 20; ++row) {
      const double x = (column + 0.5) * spacing, y = (row + 0.5) * spacing;
      const double cosine = (x * x - y * y) / (x * x + y * y);  // of 2 theta
      if (std::sqrt(x * x + y * y) > 0.3e-3 * (1 + 0.3 * cosine)) continue;
      given->x.push_back(x);
      given->y.push_back(y);
      given->velocity_x.push_back(-500 * y);
      given->velocity_y.push_back(500 * x);
    }
  return given;
}

/// Those of the built-in ellipse with an aspect ratio of 4, whose square root is exact.
std::shared_ptr<const GivenParticles> ellipse(const ParticleRequest& request) {
  auto given = std::make_shared<GivenParticles>();
  given->file = given->path = request.path;
  given->checksum = "0";
  for (int column = -20; column < 20; ++column)
    for (int row = -20; row < 20; ++row) {
      const Vector p{(column + 0.5) * spacing, (row + 0.5) * spacing};
      if (squared_length({p.x / 0.8e-3, p.y / 0.2e-3}) > 1) continue;
      given->x.push_back(p.x);
      given->y.push_back(p.y);
    }
  return given;
}

constexpr const char* peanut_on_a_beam = R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
particles_file = "peanut.csv"
velocity = [0.2, -2.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
)";

constexpr const char* two_peanuts = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[[drop]]
particles_file = "peanut.csv"
[[drop]]
particles_file = "peanut.csv"
velocity = [-1.0, 0.0]
centre_x = 0.9e-3
centre_y = 0.1e-3
)";

constexpr const char* elliptic = R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
[drop]
diameter = 0.8e-3
velocity = [0.3, -0.4]
jitter = 0
)";

struct RecordedCase {
  const char* name;
  const char* text;
  int steps;
  std::uint64_t recorded_hash;  ///< as in test_rank_equality.cpp
};

class GivenDropsOnRanks : public testing::TestWithParam<RecordedCase> {};

TEST_P(GivenDropsOnRanks, AllRanksTogetherGiveWhatOneGivesAlone) {
  const RecordedCase& c = GetParam();
  const auto run = [&](const Communicator& communicator, const std::vector<std::string>& overrides) {
    return test::run_steps(communicator, parse_case_text(c.text, "test.cfg", overrides, peanut).values, c.steps);
  };
  test::expect_equal_on_ranks(run, c.steps, c.recorded_hash);
}

INSTANTIATE_TEST_SUITE_P(Cases, GivenDropsOnRanks,
                         testing::Values(RecordedCase{"on_a_beam", peanut_on_a_beam, 200, 0x2cc0d060905046e4},
                                         RecordedCase{"two", two_peanuts, 300, 0x1783ad4fcd290551}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(GivenEllipse, HasTheBitsOfTheBuiltInOne) {
  const Communicator world(MPI_COMM_WORLD);
  const std::vector<std::string> as_file{"drop.particles_file=ellipse.csv"};
  const std::vector<std::string> built_in{"drop.shape=ellipse", "drop.aspect_ratio=4"};
  const WholeState given = test::run_steps(world, parse_case_text(elliptic, "test.cfg", as_file, ellipse).values, 100);
  const WholeState own = test::run_steps(world, parse_case_text(elliptic, "test.cfg", built_in).values, 100);
  ASSERT_GT(own.particles.size(), 150u);
  test::expect_equal(own, given, "the ellipse of a file");
}

// It draws itself together and swings beyond, turning as it did.
TEST(Peanut, SwingsAndKeepsItsArea) {
  const Communicator world(MPI_COMM_WORLD);
  const Case input = parse_case_text(peanut_on_a_beam, "test.cfg",
                                     {"solid.kind=none", "solid.length=auto", "drop.gap=auto", "drop.velocity=[0, 0]",
                                      "drop.placement=file"},
                                     peanut)
                         .values;
  const InitialState initial = build_initial_state(input);
  Simulation simulation(world, input, initial.fluid, initial.solid);
  // Half the period of a small swing, n = 2.
  const double radius = 0.5 * input.drop.diameter;
  const double half_period = std::numbers::pi * std::sqrt(1000 * radius * radius * radius / (6 * 0.072));
  struct Shape {
    double area = 0, xx = 0, yy = 0, spin = 0;
  };
  const auto shape = [&] {
    std::array<ExactSum, 4> sums;
    const FluidParticles& fluid = simulation.fluid();
    fluid.for_each_owned([&](std::size_t row) {
      const Vector p = fluid.position.at(row), v = fluid.staggered_velocity.at(row);
      sums[0].add(fluid.mass[row] / fluid.staggered_density[row]);
      sums[1].add(fluid.mass[row] * (p.x * p.x));
      sums[2].add(fluid.mass[row] * (p.y * p.y));
      sums[3].add(fluid.mass[row] * (p.x * v.y - p.y * v.x));
    });
    ExactSum::reduce(sums, simulation.communicator());
    return Shape{sums[0].value(), sums[1].value(), sums[2].value(), sums[3].value()};
  };
  const Shape before = shape();
  double least_elongation = 1;
  while (simulation.time() < half_period) {
    simulation.evaluate();
    simulation.move();
    if (simulation.step() % 20 != 0) continue;
    const Shape now = shape();
    ASSERT_NEAR(now.area, before.area, 2e-3 * before.area);
    least_elongation = std::min(least_elongation, std::sqrt(now.xx / now.yy) - 1);
  }
  EXPECT_GT(std::sqrt(before.xx / before.yy) - 1, 0.7) << "long at the start";
  EXPECT_LT(std::abs(least_elongation), 0.7);
  EXPECT_LT(least_elongation, -0.1) << "high after half a period";
  EXPECT_NEAR(shape().spin, before.spin, 0.03 * before.spin);  // shifting gives it a little
}

}  // namespace
}  // namespace sphdrop
