// Solids of any outline, their supports, and several of them: the same bits on any number of ranks, and after a
// restart.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "io/checkpoint.hpp"
#include "tests/support/equal_states.hpp"

namespace sphdrop {
namespace {

using test::expect_equal;
using test::run_steps;
using test::WholeState;
namespace fs = std::filesystem;

struct ShapeCase {
  const char* name;
  std::string text;
  int steps;
  /// Recorded once; any compiler, vector width and machine must give it.
  std::uint64_t recorded_hash;
};

// Drops start so near and so fast that they are in full contact within the steps run.
const std::string drop = R"(
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
velocity = [0.3, -3.0]
gap = 1e-6
)";

// A leaf on a slant.
const std::string outline = R"(
kind = "polygon"
polygon = [[-0.4e-3, 0], [1.9e-3, -0.5e-3], [1.95e-3, -0.3e-3], [-0.4e-3, 0.45e-3]]
clamps = [[[-1e-3, -1e-3], [0, 1e-3]]]
youngs_modulus = 20e6
)";

const std::string leaf = "mode = \"modern\"\n" + drop + "centre_x = 1.2e-3\n[solid]\n" + outline;

const std::string leaf_on_its_lattice = leaf + "lattice_direction = [22, -6]\nviscous_time = 1e-8\n";

std::string replaced(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

const std::string hypoelastic_leaf = drop + "centre_x = 1.2e-3\n[solid]\n" + outline;

// With a roller, beside an obstacle that the drop meets too.
const std::string total_lagrangian_leaf = replaced(drop, "[0.3, -3.0]", "[3.0, -2.0]") +
                                          "centre_x = 1.75e-3\n[[solid]]\n" + outline +
                                          "held_in_y = [[1.0e-3, -0.05e-3]]\nformulation = \"total_lagrangian\"\n" + R"(
[[solid]]
kind = "obstacle"
polygon = [[2.05e-3, 0], [2.4e-3, -0.25e-3], [2.4e-3, 0.25e-3]]
)";

// Two beams of different material, one on two supports, and an obstacle; one drop for each.
const std::string many = R"(
mode = "modern"
[resolution]
spacing = 0.05e-3
[time]
end = 1e-3
sound_cfl = 0.3
[contact]
wall_drag = 10.0
[[drop]]
diameter = 0.5e-3
velocity = [0.0, -3.0]
centre_x = 1.0e-3
gap = 1e-6
[[drop]]
diameter = 0.4e-3
velocity = [-1.0, -6.0]
placement = "centre"
centre_x = 1.95e-3
centre_y = 0.43e-3
[[solid]]
kind = "cantilever"
length = 1.2e-3
thickness = 0.2e-3
youngs_modulus = 30e6
damping_rate = 1000.0
[[solid]]
kind = "polygon"
polygon = [[0, 0], [1.6e-3, 0], [1.6e-3, 0.2e-3], [0, 0.2e-3]]
pinned = [[0.1e-3, 0.1e-3]]
held_in_y = [[1.5e-3, 0.1e-3]]
origin = [2.0e-3, 0.0]
density = 1500.0
viscous_time = 1e-8
youngs_modulus = 60e6
material_law = "neo_hookean"
[[solid]]
kind = "obstacle"
polygon = [[1.4e-3, -0.1e-3], [1.9e-3, -0.1e-3], [1.9e-3, 0.26e-3]]
)";

const std::string wetted_obstacle = drop + R"(
centre_x = 0.3e-3
[surface_tension]
contact_angle = 60.0
[solid]
kind = "obstacle"
polygon = [[-1e-3, -0.5e-3], [1e-3, -0.5e-3], [0.7e-3, 0.2e-3], [-0.6e-3, 0.0]]
)";

class ShapeEquality : public testing::TestWithParam<ShapeCase> {};

TEST_P(ShapeEquality, AllRanksTogetherGiveWhatOneGivesAlone) {
  const ShapeCase& c = GetParam();
  const WholeState alone = test::expect_case_equal_on_ranks(c.text, c.steps, c.recorded_hash);
  if (alone.observations.empty()) return;  // not on rank 0
  // The drop meets every solid.
  EXPECT_GT(alone.observations.back().contact_count, 0);
  for (std::size_t k = 0; k < alone.observations.back().solids.size(); ++k) {
    double largest = 0;
    for (const Observation& o : alone.observations) largest = std::max(largest, std::abs(o.solids[k].contact_force_x));
    EXPECT_GT(largest, 0.0) << "solid " << k + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, ShapeEquality,
                         testing::Values(ShapeCase{"leaf", leaf, 300, 0x8d43c43da9382374},
                                         ShapeCase{"leaf_on_its_lattice", leaf_on_its_lattice, 300, 0xbe758811fea54029},
                                         ShapeCase{"hypoelastic_leaf", hypoelastic_leaf, 250, 0xaa568471617d2b18},
                                         ShapeCase{"total_lagrangian_leaf", total_lagrangian_leaf, 250,
                                                   0xc02702f08581d31c},
                                         ShapeCase{"many", many, 300, 0x2e2fb1e15cbcebd5},
                                         ShapeCase{"wetted_obstacle", wetted_obstacle, 250, 0xc3ccb78e0cd4e898}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// Stopped within the impact and taken up on another number of ranks.
TEST(ShapeRestart, EndsInTheSameBits) {
  const Communicator world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const fs::path directory =
      fs::temp_directory_path() / ("sphdrop_solids_of_any_shape_" + std::to_string(world.size()) + "_ranks");
  if (world.rank() == 0) {
    fs::remove_all(directory);
    fs::create_directories(directory);
  }
  world.barrier();
  const Case input = parse_case_text(many, "test.cfg").values;
  const InitialState initial = build_initial_state(input);
  const auto advance = [](Simulation& simulation, std::int64_t step) {
    while (simulation.step() < step) {
      simulation.evaluate();
      simulation.move();
    }
    simulation.settle();
  };
  const auto ending = [](Simulation& simulation) {
    simulation.evaluate();
    return std::pair(state_hash(simulation), observe(simulation, 0.0));
  };
  Simulation first(world, input, initial.fluid, initial.solid);
  advance(first, 130);
  const SavedSimulation saved = first.save();
  const CheckpointHeader header{"test", "version", "commit", first.time(), first.step(), world.sum(saved.hash()), ""};
  const CheckpointTable tables[] = {saved.fluid.table(), saved.solid.table()};
  const fs::path path = write_checkpoint(world, directory, header, tables, saved.numbers);
  world.barrier();
  advance(first, 220);
  const auto expected = ending(first);
  const auto expect_same = [&](const Communicator& communicator) {
    Simulation second(communicator, input, initial.fluid, initial.solid);
    second.restore(read_checkpoint(communicator, path));
    advance(second, 220);
    const auto found = ending(second);
    EXPECT_EQ(found.first, expected.first);
    expect_equal(found.second, expected.second, "after the restart");
  };
  expect_same(world);
  if (world.rank() == 0) expect_same(self);
  world.barrier();
  if (world.rank() == 0) fs::remove_all(directory);
}

}  // namespace
}  // namespace sphdrop
