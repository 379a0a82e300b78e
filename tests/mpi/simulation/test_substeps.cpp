// The solid's sub-steps and mode fast: nothing is lost to the other's clock, nothing is gained from it, and the answer
// is that of a step for both, on any number of ranks.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/equal_states.hpp"

namespace sphdrop {
namespace {

using test::run_steps;
using test::WholeState;

constexpr const char* fast_beam = R"(
mode = "fast"
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
[drop]
diameter = 0.6e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[gravity]
acceleration = [1.0, -9.81]
)";

// Whatever depends on velocities too.
constexpr const char* damped_body = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
solid_substeps = 3
[drop]
diameter = 0.6e-3
velocity = [0.0, -3.0]
gap = 1e-6
[solid]
kind = "fixed_fixed_beam"
length = 2e-3
youngs_modulus = 50e6
formulation = "total_lagrangian"
damping_ratio = 0.1
viscous_time = 1e-8
[contact]
stiffness_form = "fixed"
damping_ratio = 0.1
wall_drag = 20.0
)";

struct RecordedCase {
  const char* name;
  const char* text;
  int steps;
  std::uint64_t recorded_hash;  ///< as in test_rank_equality.cpp
};

class SubstepsOnRanks : public testing::TestWithParam<RecordedCase> {};

TEST_P(SubstepsOnRanks, AllRanksTogetherGiveWhatOneGivesAlone) {
  const RecordedCase& c = GetParam();
  const WholeState alone = test::expect_case_equal_on_ranks(c.text, c.steps, c.recorded_hash);
  if (alone.observations.empty()) return;  // not on rank 0
  EXPECT_GT(alone.observations.back().contact_count, 0) << "there is nothing to pass on";
}

INSTANTIATE_TEST_SUITE_P(Cases, SubstepsOnRanks,
                         testing::Values(RecordedCase{"fast_beam", fast_beam, 300, 0xf2bf3dc0807bcf06},
                                         RecordedCase{"damped_body", damped_body, 200, 0xf4d23b339ea613e4}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

Vector momentum(const Simulation& simulation) {
  std::array<ExactSum, 2> sums;
  const auto add = [&](const auto& set) {
    set.for_each_owned([&](std::size_t row) {
      sums[0].add(set.mass[row] * set.staggered_velocity.x[row]);
      sums[1].add(set.mass[row] * set.staggered_velocity.y[row]);
    });
  };
  add(simulation.fluid());
  add(simulation.solid());
  ExactSum::reduce(sums, simulation.communicator());
  return {sums[0].value(), sums[1].value()};
}

// A beam that nothing holds: what the drop loses it must have, to rounding.
TEST(Substeps, KeepMomentum) {
  const Communicator world(MPI_COMM_WORLD);
  for (const char* formulation : {"cells", "total_lagrangian"}) {
    const Case input = parse_case_text(fast_beam, "test.cfg",
                                       {"gravity.acceleration=[0, 0]", "solid.clamp=strips",
                                        fmt::format("solid.formulation={}", formulation)})
                           .values;
    ASSERT_EQ(input.time.solid_substeps, 3);
    InitialState initial = build_initial_state(input);
    std::fill(initial.solid.is_fixed.begin(), initial.solid.is_fixed.end(), false);
    Simulation simulation(world, input, initial.fluid, initial.solid);
    const Vector before = momentum(simulation);
    for (int k = 0; k < 400; ++k) {
      simulation.evaluate();
      simulation.move();
    }
    simulation.settle();
    const Vector change = momentum(simulation) - before;
    EXPECT_LT(length(change), 1e-13 * length(before)) << formulation;
    ExactSum drop;
    simulation.fluid().for_each_owned([&](std::size_t row) {
      drop.add(simulation.fluid().mass[row] * simulation.fluid().staggered_velocity.y[row]);
    });
    ExactSum::reduce(std::span(&drop, 1), world);
    EXPECT_GT(drop.value(), 0.9 * before.y) << formulation << ": the beam got less than a tenth of it";
  }
}

struct Swing {
  double deepest = 0, time_of_deepest = 0;  // m, s
  double largest_gain = 0;                  // of the energy over that at the start, relative
  double steps = 0;
};

Swing swing(const Communicator& communicator, const std::vector<std::string>& overrides) {
  const Case input = parse_case_text(fast_beam, "test.cfg", overrides).values;
  const InitialState initial = build_initial_state(input);
  Simulation simulation(communicator, input, initial.fluid, initial.solid);
  Swing result;
  double start = 0, next = 0;
  while (simulation.time() < input.time.end) {
    simulation.evaluate();
    if (simulation.time() >= next) {
      next += 2e-6;
      const Observation o = observe(simulation, start);
      if (start == 0) start = o.total;
      result.largest_gain = std::max(result.largest_gain, o.total / start - 1.0);
      if (-o.deflection > result.deepest) {
        result.deepest = -o.deflection;
        result.time_of_deepest = o.time;
      }
    }
    simulation.move();
  }
  result.steps = static_cast<double>(simulation.step());
  return result;
}

// Through the impact and half a swing of the beam. A reaction held over the sub-steps would feed the beam.
TEST(Substeps, GiveTheSameBeamAndNoEnergy) {
  const Communicator self(MPI_COMM_SELF);
  const std::vector<std::string> common{"gravity.acceleration=[0, 0]", "drop.velocity=[0, -0.8]", "solid.length=4e-3",
                                        "time.end=0.6e-3", "fluid.density_treatment=density_diffusion"};
  std::vector<std::string> fine = common;
  fine.insert(fine.end(), {"mode=modern", "time.sound_cfl=0.1"});
  const Swing reference = swing(self, fine), fast = swing(self, common);
  EXPECT_LT(fast.steps, reference.steps / 12);
  EXPECT_LT(fast.time_of_deepest, 0.55e-3);
  EXPECT_NEAR(fast.deepest, reference.deepest, 0.01 * reference.deepest);
  EXPECT_NEAR(fast.time_of_deepest, reference.time_of_deepest, 0.02 * reference.time_of_deepest);
  EXPECT_LT(fast.largest_gain, 1e-3);
}

// It falls, spreads and takes the beam along: lists and contact are made anew by other reasons at other times.
TEST(RelativeMotion, AndTheSkinDoNotMatter) {
  const Communicator world(MPI_COMM_WORLD);
  std::vector<std::string> thin{"drop.gap=0.08e-3", "solid.youngs_modulus=100e6"}, thick = thin;
  thin.push_back("parallel.skin=0.1");
  thick.push_back("parallel.skin=0.7");
  const WholeState often = run_steps(world, fast_beam, 500, thin), seldom = run_steps(world, fast_beam, 500, thick);
  EXPECT_GT(often.redistributions, 2 * seldom.redistributions);
  EXPECT_GT(seldom.redistributions, 1);
  EXPECT_GT(seldom.observations.back().contact_count, 0);
  test::expect_equal(often, seldom, "skin");
}

// As it falls, nothing happens to its surface.
TEST(RelativeMotion, LeavesAFallingDropAlone) {
  const Communicator self(MPI_COMM_SELF);
  const std::vector<std::string> high{"drop.gap=0.5e-3", "drop.velocity=[0, -3]",
                                      "surface_tension.detection_displacement=0.03"};
  std::vector<std::string> absolute = high;
  absolute.push_back("surface_tension.detection_motion=absolute");
  const int steps = 100;  // 1 spacing
  EXPECT_GT(run_steps(self, fast_beam, steps, absolute).detections, 30);
  const WholeState relative = run_steps(self, fast_beam, steps, high);
  EXPECT_LT(relative.detections, 10);
  EXPECT_LT(relative.redistributions, 4);
}

}  // namespace
}  // namespace sphdrop
