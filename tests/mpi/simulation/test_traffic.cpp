// The traffic that is reported, against MPI's own calls, which this program counts on their way, and against the
// formula of tests/benchmarks/SCALING.md for what a step exchanges.

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <string>

#include "config/case_file.hpp"
#include "setup/initial_state.hpp"
#include "simulation/rank_traffic.hpp"
#include "simulation/simulation.hpp"

namespace {

sphdrop::Traffic counted_calls;

std::size_t bytes_of(std::int64_t count, MPI_Datatype type) {
  int size = 0;
  MPI_Type_size(type, &size);
  return static_cast<std::size_t>(count * size);
}

std::int64_t total_of(const int* counts, MPI_Comm communicator) {
  int ranks = 0;
  MPI_Comm_size(communicator, &ranks);
  std::int64_t total = 0;
  for (int k = 0; k < ranks; ++k) total += counts[k];
  return total;
}

int ranks_of(MPI_Comm communicator) {
  int ranks = 0;
  MPI_Comm_size(communicator, &ranks);
  return ranks;
}

}  // namespace

// MPI's profiling interface: a program's own MPI_X takes the place of the library's, which is PMPI_X too.
extern "C" {
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  counted_calls.add(sphdrop::TrafficKind::message_sent, bytes_of(count, type));
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}
int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request) {
  counted_calls.add(sphdrop::TrafficKind::message_received, bytes_of(count, type));
  return PMPI_Irecv(data, count, type, from, tag, comm, request);
}
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  counted_calls.add(sphdrop::TrafficKind::reduction, bytes_of(count, type));
  return PMPI_Allreduce(in, out, count, type, op, comm);
}
int MPI_Iallreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
                   MPI_Request* request) {
  counted_calls.add(sphdrop::TrafficKind::pending_reduction, bytes_of(count, type));
  return PMPI_Iallreduce(in, out, count, type, op, comm, request);
}
int MPI_Allgather(const void* in, int in_count, MPI_Datatype in_type, void* out, int out_count, MPI_Datatype out_type,
                  MPI_Comm comm) {
  counted_calls.add(sphdrop::TrafficKind::gather, bytes_of(std::int64_t{out_count} * ranks_of(comm), out_type));
  return PMPI_Allgather(in, in_count, in_type, out, out_count, out_type, comm);
}
int MPI_Allgatherv(const void* in, int in_count, MPI_Datatype in_type, void* out, const int* counts, const int* starts,
                   MPI_Datatype out_type, MPI_Comm comm) {
  counted_calls.add(sphdrop::TrafficKind::gather, bytes_of(total_of(counts, comm), out_type));
  return PMPI_Allgatherv(in, in_count, in_type, out, counts, starts, out_type, comm);
}
int MPI_Gatherv(const void* in, int in_count, MPI_Datatype in_type, void* out, const int* counts, const int* starts,
                MPI_Datatype out_type, int root, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  counted_calls.add(sphdrop::TrafficKind::gather,
                    rank == root ? bytes_of(total_of(counts, comm), out_type) : bytes_of(in_count, in_type));
  return PMPI_Gatherv(in, in_count, in_type, out, counts, starts, out_type, root, comm);
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  counted_calls.add(sphdrop::TrafficKind::broadcast, bytes_of(count, type));
  return PMPI_Bcast(data, count, type, root, comm);
}
int MPI_Alltoall(const void* in, int in_count, MPI_Datatype in_type, void* out, int out_count, MPI_Datatype out_type,
                 MPI_Comm comm) {
  counted_calls.add(sphdrop::TrafficKind::all_to_all, bytes_of(std::int64_t{out_count} * ranks_of(comm), out_type));
  return PMPI_Alltoall(in, in_count, in_type, out, out_count, out_type, comm);
}
int MPI_Barrier(MPI_Comm comm) {
  counted_calls.add(sphdrop::TrafficKind::barrier, 0);
  return PMPI_Barrier(comm);
}
}

namespace sphdrop {
namespace {

constexpr const char* cantilever = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.8e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 3e-3
[fluid]
density_correction_interval = 10
)";

constexpr const char* cells_and_gauge = R"(
mode = "modern"
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
sound_cfl = 0.3
[drop]
diameter = 0.8e-3
velocity = [0.0, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 3e-3
[fluid]
gauge_pressure = "on"
[contact]
wall_drag = 20.0
)";

const std::string wetted = std::string(cantilever) + R"(
[surface_tension]
contact_angle = 40.0
[contact]
stiffness_form = "fixed"
wall_drag = 1.0
)";

constexpr const char* beam_alone = R"(
[resolution]
spacing = 0.0625e-3
[time]
end = 1e-3
[drop]
shape = "none"
[solid]
kind = "cantilever"
length = 12e-3
initial_tip_velocity = 1.0
)";

// Columns that travel in a step, of 8 bytes a row.
struct Columns {
  int liquid;      // position, velocity, density
  int solid;       // of hypoelastic particles position, velocity, density and stress; of cells the position
  int contact;     // gathered; two forces come back
  bool has_gauge;  // four words of sums
};

void add_exchange(Traffic& traffic, const ExchangePlan& plan, int rank, int columns, bool is_scatter = false) {
  const auto add = [&](TrafficKind kind, std::span<const RankRows> peers) {
    for (const RankRows& peer : peers)
      if (peer.rank != rank) traffic.add(kind, peer.rows.size() * static_cast<std::size_t>(columns) * 8);
  };
  add(TrafficKind::message_sent, is_scatter ? plan.receives() : plan.sends());
  add(TrafficKind::message_received, is_scatter ? plan.sends() : plan.receives());
}

// What an ordinary step exchanges.
Traffic step_formula(const Simulation& simulation, const Columns& columns) {
  const int rank = simulation.communicator().rank();
  Traffic traffic;
  const auto add_interface = [&](const InterfaceGather& gather, int gathered) {
    add_exchange(traffic, gather.plan(), rank, gathered);
    add_exchange(traffic, gather.plan(), rank, 2, true);
  };
  if (simulation.fluid_total() > 0) {
    add_exchange(traffic, simulation.distribution().fluid_halo(), rank, columns.liquid);
    add_exchange(traffic, simulation.surface_tension().band().plan(), rank, 2);
    if (simulation.input().is_wetting())
      add_exchange(traffic, simulation.surface_tension().node_forces().plan(), rank, 2, true);
    add_interface(simulation.contact().fluid_gather(), columns.contact);
    add_interface(simulation.contact().solid_gather(), columns.contact);
  }
  add_exchange(traffic, simulation.distribution().solid_halo(), rank, columns.solid);
  traffic.add(TrafficKind::pending_reduction, 15 * 8);
  if (columns.has_gauge) traffic.add(TrafficKind::pending_reduction, 4 * 8);
  return traffic;
}

struct CountedRun {
  explicit CountedRun(const std::string& text)
      : communicator(MPI_COMM_WORLD),
        input(parse_case_text(text, "test.cfg").values),
        initial(build_initial_state(input)),
        simulation(communicator, input, initial.fluid, initial.solid) {}
  Communicator communicator;
  Case input;
  InitialState initial;
  Simulation simulation;
};

// Compares `steps` steps with the formula, but for those in which lists or curves are made or densities corrected.
void expect_formula(const std::string& text, const Columns& columns, int steps) {
  CountedRun run(text);
  Simulation& simulation = run.simulation;
  simulation.evaluate();
  const bool is_corrected =
      run.input.drop.is_liquid() && run.input.fluid.density_treatment == DensityTreatment::moving_least_squares;
  int ordinary = 0, corrected = 0;
  for (int k = 0; k < steps; ++k) {
    const Traffic before = run.communicator.traffic();
    const std::int64_t made = simulation.redistributions() + simulation.detections();
    simulation.move();
    simulation.evaluate();
    if (simulation.redistributions() + simulation.detections() != made) continue;
    Traffic expected = step_formula(simulation, columns);
    if (is_corrected && simulation.step() % run.input.fluid.density_correction_interval == 0) {
      add_exchange(expected, simulation.distribution().fluid_halo(), run.communicator.rank(), 3);
      ++corrected;
    }
    ASSERT_EQ(run.communicator.traffic() - before, expected) << "step " << k;
    ++ordinary;
  }
  EXPECT_GT(ordinary, steps / 2);
  EXPECT_TRUE(!is_corrected || corrected > 0);
}

TEST(Traffic, IsWhatMpiIsCalledFor) {
  for (const std::string& text :
       {std::string(cantilever), std::string(cells_and_gauge), wetted, std::string(beam_alone)}) {
    const Traffic before = counted_calls;
    CountedRun run(text);
    for (int k = 0; k < 60; ++k) {
      run.simulation.evaluate();
      run.simulation.move();
    }
    run.simulation.settle();
    EXPECT_EQ(run.communicator.traffic(), counted_calls - before);
  }
}

TEST(Traffic, OfAStepFollowsTheFormula) {
  expect_formula(cantilever, {5, 8, 2, false}, 60);
  expect_formula(cells_and_gauge, {5, 2, 4, true}, 60);
  expect_formula(wetted, {5, 8, 4, false}, 60);
  expect_formula(beam_alone, {5, 8, 2, false}, 20);
}

// A beam is cut across: two messages at each cut, of the columns of particles within reach behind it.
TEST(Traffic, OfABeamFollowsFromItsCuts) {
  CountedRun run(beam_alone);
  Simulation& simulation = run.simulation;
  constexpr std::int64_t steps = 10;
  simulation.evaluate();
  for (std::int64_t k = 1; k < steps; ++k) {
    simulation.move();
    simulation.evaluate();
  }
  const Traffic mine = simulation.timer().traffic_of_steps();
  const std::int64_t messages = run.communicator.sum(mine.of(TrafficKind::message_sent).calls);
  const std::int64_t bytes = run.communicator.sum(mine.of(TrafficKind::message_sent).bytes);
  const std::int64_t cuts = run.communicator.size() - 1;
  EXPECT_EQ(messages, steps * 2 * cuts);
  const double reach = simulation.parameters().range.list_reach() / run.input.resolution.spacing;
  const double rows = std::round(run.input.solid.thickness / run.input.resolution.spacing);
  const auto of_columns = [&](double columns) {
    return static_cast<double>(steps * 2 * cuts) * rows * columns * 8 * 8;
  };
  EXPECT_GE(static_cast<double>(bytes), of_columns(std::floor(reach)));
  EXPECT_LE(static_cast<double>(bytes), of_columns(std::ceil(reach)));
}

TEST(Traffic, OfTheReportIsThatOfThePhases) {
  CountedRun run(cantilever);
  Simulation& simulation = run.simulation;
  constexpr std::int64_t steps = 40;
  simulation.evaluate();
  for (std::int64_t k = 1; k < steps; ++k) {
    simulation.move();
    simulation.evaluate();
  }
  const Traffic all = run.communicator.traffic();
  const std::vector<RankTraffic> traffic = traffic_of_ranks(simulation, steps);
  ASSERT_EQ(traffic.size(), 3U);
  EXPECT_EQ(traffic[0].occasion, "step");
  EXPECT_DOUBLE_EQ(traffic[0].collectives, 1.0);
  EXPECT_DOUBLE_EQ(traffic[0].collective_bytes, 120.0);
  double messages = 0, bytes = 0;
  for (const RankTraffic& t : traffic) {
    EXPECT_GT(t.times, 0);
    EXPECT_GE(t.most_messages, t.messages);
    EXPECT_GE(t.most_bytes, t.bytes);
    messages += t.messages * static_cast<double>(t.times);
    bytes += t.bytes * static_cast<double>(t.times);
  }
  // Each is counted where it is sent and where it arrives.
  const double ranks = run.communicator.size();
  const TrafficCount sent = all.of(TrafficKind::message_sent);
  EXPECT_NEAR(messages * ranks, 2.0 * static_cast<double>(run.communicator.sum(sent.calls)), 1e-6);
  EXPECT_NEAR(bytes * ranks, 2.0 * static_cast<double>(run.communicator.sum(sent.bytes)), 1e-3);
}

}  // namespace
}  // namespace sphdrop
