// A run taken up from its saved state, by as many ranks or by another number of them, goes on to the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "simulation/observation.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {
namespace {

/// This rank's share of what a checkpoint's file would hold of a table.
Checkpoint::Table share(const Communicator& from, const Communicator& to, const CheckpointTable& table) {
  const auto ids = from.all_gather(std::span<const std::int64_t>(table.ids.joined()));
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  const std::size_t rank = static_cast<std::size_t>(to.rank()), ranks = static_cast<std::size_t>(to.size());
  const std::size_t first = ids.size() * rank / ranks, last = ids.size() * (rank + 1) / ranks;
  Checkpoint::Table result;
  result.name = table.name;
  result.total_rows = table.total_rows;
  result.first_id = first < last ? ids[order[first]] : 0;
  result.row_count = static_cast<std::int64_t>(last - first);
  for (const CheckpointColumn& column : table.columns) {
    const auto all = from.all_gather(std::span<const double>(column.values.joined()));
    Checkpoint::Column& taken = result.columns.emplace_back();
    taken.name = column.name;
    for (std::size_t k = first; k < last; ++k) taken.values.push_back(all[order[k]]);
  }
  return result;
}

Checkpoint checkpoint_of(const Simulation& simulation, const Communicator& to) {
  const Communicator& from = simulation.communicator();
  const SavedSimulation saved = simulation.save();
  Checkpoint checkpoint;
  checkpoint.header.state_hash = from.sum(saved.hash());
  checkpoint.tables = {share(from, to, saved.fluid.table()), share(from, to, saved.solid.table())};
  checkpoint.numbers = saved.numbers;
  return checkpoint;
}

void run(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) {
    simulation.evaluate();
    simulation.move();
  }
  simulation.settle();
}

std::uint64_t final_hash(Simulation& simulation) {
  simulation.evaluate();
  return state_hash(simulation);
}

class Restart : public testing::TestWithParam<const char*> {};

TEST_P(Restart, GoesOnToTheSameBits) {
  const Communicator world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const Case input = parse_case_text(R"(
mode = "modern"
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
youngs_modulus = 6e6
)",
                                     "test.cfg", {GetParam()})
                         .values;
  const InitialState initial = build_initial_state(input);
  Simulation straight(world, input, initial.fluid, initial.solid);
  run(straight, 120);
  const Checkpoint for_all = checkpoint_of(straight, world), for_one = checkpoint_of(straight, self);
  run(straight, 80);
  const std::uint64_t expected = final_hash(straight);

  Simulation together(world, input, initial.fluid, initial.solid);
  together.restore(for_all);
  run(together, 80);
  EXPECT_EQ(final_hash(together), expected);
  if (world.rank() != 0) return;
  Simulation alone(self, input, initial.fluid, initial.solid);
  alone.restore(for_one);
  run(alone, 80);
  EXPECT_EQ(final_hash(alone), expected);
}

INSTANTIATE_TEST_SUITE_P(Solids, Restart,
                         testing::Values("solid.formulation=hypoelastic", "solid.formulation=cells",
                                         "solid.formulation=total_lagrangian", "solid.viscous_time=1e-8",
                                         "solid.damping_ratio=0.2", "time.solid_substeps=3",
                                         "surface_tension.detection_motion=relative"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace sphdrop
