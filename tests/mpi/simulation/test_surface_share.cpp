// The liquid's surface is worked on in pieces, by those whose particles it acts on.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "simulation/shared_energy.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {
namespace {

struct ShortRun {
  explicit ShortRun(const std::string& text)
      : communicator(MPI_COMM_WORLD),
        input(parse_case_text(text, "test.cfg").values),
        initial(build_initial_state(input)),
        simulation(communicator, input, initial.fluid, initial.solid) {
    // The surface's work is dealt out once it has been found.
    for (int k = 0; k < 3; ++k) {
      simulation.evaluate();
      simulation.move();
    }
    simulation.evaluate();
  }
  Communicator communicator;
  Case input;
  InitialState initial;
  Simulation simulation;
};

constexpr const char* drop = R"(
[resolution]
spacing = 2.5e-5
[time]
end = 1e-3
[drop]
diameter = 3e-3
arrangement = "lattice"
)";

// Besides its own a rank works on a few nodes at both ends of its stretches of the outline.
TEST(SurfaceShare, IsAPieceForEachRank) {
  ShortRun run(drop);
  const SurfaceTensionStep& surface = run.simulation.surface_tension();
  const auto own = static_cast<std::int64_t>(surface.own_nodes().size());
  const auto worked_on = static_cast<std::int64_t>(surface.piece().nodes.size());
  const std::int64_t all = run.communicator.sum(own);
  // A lattice's steps are longer than its spacing, some of them.
  const double outline = std::numbers::pi * 3e-3 / 2.5e-5;
  EXPECT_GT(static_cast<double>(all), outline / std::numbers::sqrt2 - 20);
  EXPECT_LT(static_cast<double>(all), outline);
  const SurfaceReport report = surface.report();
  EXPECT_NEAR(report.length, std::numbers::pi * 3e-3, 0.02 * report.length);
  EXPECT_NEAR(report.area, std::numbers::pi * 1.5e-3 * 1.5e-3, 0.005 * report.area);
  EXPECT_NEAR(report.mean_curvature, 1 / 1.5e-3, 0.05 / 1.5e-3);  // of a staircase
  EXPECT_EQ(report.curve_count, 1);
  EXPECT_GE(worked_on, own);
  if (run.communicator.size() == 1) {
    EXPECT_EQ(worked_on, all);
    return;
  }
  EXPECT_LE(worked_on, own + 60);
  EXPECT_LT(run.communicator.max(worked_on), run.communicator.size() >= 4 ? all / 2 : all);
  const std::int64_t rows = run.communicator.sum(static_cast<std::int64_t>(surface.band().plan().sent_row_count()));
  EXPECT_LE(rows, 300 * run.communicator.size());
  EXPECT_GT(rows, 0);
}

TEST(SharedEnergy, IsTheSameWhoeverAddsIt) {
  const Communicator communicator(MPI_COMM_WORLD);
  const int rank = communicator.rank(), ranks = communicator.size();
  const double quantum = 1e-12;
  SharedEnergy dealt_out(communicator, quantum), on_one(communicator, quantum);
  for (int k = 0; k < 1000; ++k) {
    const double term = std::sin(1.7 * k) / (1.0 + 0.01 * k);
    if (k % ranks == rank) dealt_out.add(term);
    if (rank == ranks - 1) on_one.add(term);
    if (k == 499) {
      EXPECT_EQ(dealt_out.total(), 0.0);  // nothing is booked yet
      dealt_out.book();
      on_one.book();
    }
  }
  const double half = dealt_out.total();
  EXPECT_NE(half, 0.0);
  EXPECT_EQ(half, on_one.total());
  dealt_out.book();
  on_one.book();
  EXPECT_EQ(dealt_out.total(), on_one.total());
  EXPECT_NE(dealt_out.total(), half);

  SharedEnergy again(communicator, quantum);
  again.restore(dealt_out.total());
  EXPECT_EQ(again.total(), dealt_out.total());
  again.restart();
  EXPECT_EQ(again.total(), 0.0);
}

}  // namespace
}  // namespace sphdrop
