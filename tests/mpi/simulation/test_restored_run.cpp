// A run of the modern liquid taken up from a checkpoint, on another number of ranks, ends in the same bits as one that
// was never stopped.

#include <gtest/gtest.h>

#include <filesystem>

#include "io/checkpoint.hpp"
#include "tests/support/whole_state.hpp"

namespace sphdrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* impact = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.2
capillary_cfl = 0.2
[fluid]
viscosity_form = "physical"
gauge_pressure = "on"
gauge_relaxation_time = 5e-6
shifting = "on"
[drop]
diameter = 0.8e-3
velocity = [0.0, -2.0]
relaxation_time = 30e-6
gap = 1e-6
[solid]
kind = "rigid_wall"
)";

struct Ending {
  std::uint64_t hash = 0;
  Observation observation;
};

/// `checkpoint`: to start from, or null.
struct Stretch {
  Stretch(const Communicator& communicator, const Case& input, const Checkpoint* checkpoint)
      : initial(build_initial_state(input)), simulation(communicator, input, initial.fluid, initial.solid) {
    if (checkpoint != nullptr) simulation.restore(*checkpoint);
  }

  void advance_to(std::int64_t step) {
    while (simulation.step() < step) {
      simulation.evaluate();
      simulation.move();
    }
    simulation.settle();
  }

  Ending ending() {
    simulation.evaluate();
    return {state_hash(simulation), observe(simulation, 0.0)};
  }

  InitialState initial;
  Simulation simulation;
};

class RestoredRun : public testing::Test {
 protected:
  RestoredRun() {
    if (world.rank() == 0) {
      fs::remove_all(directory);
      fs::create_directories(directory);
    }
    world.barrier();
  }
  ~RestoredRun() override {
    world.barrier();
    if (world.rank() == 0) fs::remove_all(directory);
  }

  fs::path write(const Communicator& communicator, Simulation& simulation) const {
    const SavedSimulation saved = simulation.save();
    const CheckpointHeader header{
        "test", "version", "commit", simulation.time(), simulation.step(), communicator.sum(saved.hash()), ""};
    const CheckpointTable tables[] = {saved.fluid.table(), saved.solid.table()};
    return write_checkpoint(communicator, directory, header, tables, saved.numbers);
  }

  Communicator world{MPI_COMM_WORLD}, self{MPI_COMM_SELF};
  fs::path directory = fs::temp_directory_path() / ("sphdrop_restored_run_" + std::to_string(world.size()) + "_ranks");
};

// Stops while the drop relaxes, at the step where it starts, between two shifts and in the impact.
TEST_F(RestoredRun, EndsInTheSameBits) {
  const Case input = parse_case_text(impact, "test.cfg").values;
  constexpr std::int64_t last = 330;
  Stretch whole(self, input, nullptr);
  std::int64_t start = 0;
  for (; whole.simulation.time() < 0; ++start) whole.advance_to(start + 1);
  ASSERT_GT(start, 20);
  ASSERT_LT(start, 150);
  whole.advance_to(last);
  const Ending expected = whole.ending();
  ASSERT_GT(expected.observation.gauge_pressure, 0.0);
  ASSERT_NE(expected.observation.shifting_work, 0.0);
  ASSERT_NE(expected.observation.gauge_adjustment, 0.0);
  ASSERT_NE(expected.observation.sharing_work, 0.0);

  for (const std::int64_t stop : {std::int64_t{20}, start, std::int64_t{222}, std::int64_t{301}}) {
    SCOPED_TRACE(stop);
    Stretch first(world, input, nullptr);
    first.advance_to(stop);
    const fs::path path = write(world, first.simulation);
    world.barrier();

    const auto expect_equal = [&](const Communicator& communicator) {
      const Checkpoint checkpoint = read_checkpoint(communicator, path);
      Stretch second(communicator, input, &checkpoint);
      second.advance_to(last);
      const Ending found = second.ending();
      EXPECT_EQ(found.hash, expected.hash);
      for (const ObservedQuantity& q : observed_quantities())
        EXPECT_EQ(std::bit_cast<std::uint64_t>(found.observation.*q.value),
                  std::bit_cast<std::uint64_t>(expected.observation.*q.value))
            << q.name;
    };
    expect_equal(world);
    if (world.rank() == 0) expect_equal(self);
    world.barrier();
  }
}

}  // namespace
}  // namespace sphdrop
