// Work is dealt out evenly, that of the surface included.

#include <gtest/gtest.h>

#include <string>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {
namespace {

// What takes how long, in particles of the liquid: tests/benchmarks/README.md.
struct Work {
  double solid_particle, curve_point;
};

double imbalance(const Simulation& simulation, const Work& work) {
  const Communicator& communicator = simulation.communicator();
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  double mine = count(simulation.fluid().owned_count()) + work.solid_particle * count(simulation.solid().owned_count());
  mine += work.curve_point * count(simulation.surface_tension().own_nodes().size());
  double sum = 0;
  for (const double share : communicator.all_gather(std::span<const double>(&mine, 1))) sum += share;
  return communicator.max(mine) * communicator.size() / sum;
}

// Of a drop at 25 um spacing, with what is written of mode and solid.
// `smallest_cells`: how many times the lists' reach a cell must at least be wide.
double imbalance_of(const std::string& mode, const std::string& diameter, const std::string& solid, const Work& work,
                    double smallest_cells = 1) {
  const Communicator communicator(MPI_COMM_WORLD);
  const std::string text =
      mode + "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n[drop]\ndiameter = " + diameter + "\n" + solid;
  const Case input = parse_case_text(text, "test.cfg").values;
  const InitialState initial = build_initial_state(input);
  Simulation simulation(communicator, input, initial.fluid, initial.solid);
  const double cells = simulation.distribution().cell_edge() / simulation.distribution().range().list_reach();
  EXPECT_GE(cells, smallest_cells);
  simulation.evaluate();
  // The surface has been found. Its nodes count from the next step on.
  simulation.move();
  simulation.evaluate();
  EXPECT_EQ(simulation.distribution().quality().repartitions, communicator.size() > 1 ? 2 : 0);
  EXPECT_LE(simulation.distribution().quality().imbalance, 1.05);
  if (communicator.size() == 1 && input.drop.is_liquid()) {
    EXPECT_GT(simulation.surface_tension().own_nodes().size(), 100U);
  }
  return imbalance(simulation, work);
}

TEST(LoadBalance, OfADropOnABeamOfParticles) {
  EXPECT_LE(imbalance_of("", "1e-3", "[solid]\nkind = \"cantilever\"\nlength = 8e-3\n", {0.9, 0.65}), 1.05);
}

TEST(LoadBalance, OfADropAlone) {
  EXPECT_LE(imbalance_of("", "2e-3", "", {0.9, 0.65}), 1.05);
}

// 5027 particles fill 690 cells as wide as the lists reach, 20107 four times as many: all dealt out by 172 wider ones.
TEST(LoadBalance, OfLargerCells) {
  const auto coarse = [](int cells) { return "[parallel]\ncells_per_process = " + std::to_string(cells) + "\n"; };
  const int ranks = Communicator(MPI_COMM_WORLD).size();
  EXPECT_LE(imbalance_of("", "2e-3", coarse(160 / ranks), {0.9, 0.65}, 2), 1.05);
  EXPECT_LE(imbalance_of("", "4e-3", coarse(160 / ranks), {0.9, 0.65}, 4), 1.05);
  EXPECT_LE(imbalance_of("mode = \"modern\"\n", "2e-3",
                         "[solid]\nkind = \"cantilever\"\nlength = 16e-3\n" + coarse(160 / ranks), {0.125, 0.65}, 2),
            1.05);
}

// All must agree on it, whichever particles each sets up.
TEST(EdgeOfTheCells, FollowsFromTheWholeBeam) {
  const Communicator communicator(MPI_COMM_WORLD);
  for (const char* mode : {"", "mode = \"modern\"\n"}) {
    const Case input = parse_case_text(std::string(mode) +
                                           "[resolution]\nspacing = 2.5e-5\n[time]\nend = 1e-3\n"
                                           "[drop]\nshape = \"none\"\n[solid]\nkind = \"cantilever\"\n"
                                           "length = 64e-3\nthickness = 1e-3\n[parallel]\ncells_per_process = " +
                                           std::to_string(160 / communicator.size()) + "\n",
                                       "test.cfg")
                           .values;
    const InitialState whole = build_initial_state(input),
                       share = build_initial_state(input, {communicator.rank(), communicator.size()});
    const double expected = Simulation(communicator, input, whole.fluid, whole.solid).distribution().cell_edge();
    const Simulation simulation(communicator, input, share.fluid, share.solid);
    EXPECT_EQ(simulation.distribution().cell_edge(), expected);
    EXPECT_GE(expected, 2 * simulation.distribution().range().list_reach());
  }
}

TEST(LoadBalance, OfADropOnABeamOfCells) {
  EXPECT_LE(
      imbalance_of("mode = \"modern\"\n", "2e-3", "[solid]\nkind = \"cantilever\"\nlength = 16e-3\n", {0.125, 0.65}),
      1.05);
}

}  // namespace
}  // namespace sphdrop
