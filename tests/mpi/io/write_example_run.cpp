// Writes a small run directory (argv[1]) with everything a run leaves behind, for the tests of the readers; run by
// test_failing_disk.py on a disk that fails, too. Every number follows from the id, so that readers can be checked.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "io/history.hpp"
#include "io/output_directory.hpp"
#include "io/provenance.hpp"
#include "io/snapshot_series.hpp"

namespace sphdrop {
namespace {

constexpr std::int64_t total = 4000;

void write_run(const Communicator& world, const std::filesystem::path& directory) {
  prepare_output_directory(world, directory);
  RunRecord record(world, {"write_example_run", directory.string()});
  std::vector<std::int64_t> ids, material;
  std::vector<double> x, y, velocity_x, velocity_y, pressure;
  for (std::int64_t id = world.rank(); id < total; id += world.size()) {
    const auto number = static_cast<double>(id);
    ids.push_back(id);
    material.push_back(id < 1000 ? 0 : 1);
    x.push_back(number * 1e-6);
    y.push_back(std::sqrt(number));
    velocity_x.push_back(-number);
    velocity_y.push_back(number / 3.0);
    pressure.push_back(100.0 + number);
  }
  const std::array columns = {SnapshotColumn::integer("material", "0 liquid, 1 solid", material),
                              SnapshotColumn::vector("velocity", "m/s", "velocity", velocity_x, velocity_y),
                              SnapshotColumn::scalar("pressure", "Pa", "pressure", pressure)};
  SnapshotSeries series(world, directory);
  for (int number = 0; number < 3; ++number) {
    series.write(
        {number * 1e-4, number * 20000, 0xfeedbeef00000000ULL + static_cast<unsigned>(number), "example", "0.1.0"},
        {total, ids, x, y}, columns);
  }
  if (world.rank() == 0) {
    auto history = HistoryWriter::create(directory, {{"time", "s", "simulated time"}, {"drop_width", "m", "D(t)"}});
    for (int row = 0; row < 5; ++row) history.append(std::array{row * 5e-5, 1e-3 + row / 3e6});
    history.close();
    std::ofstream(directory / "case.cfg") << "name = \"example\"\n";
  }
  record.set("particles", total);
  record.finish("completed", 0xfeedbeef00000002ULL);
  record.write(world, directory);
}

}  // namespace
}  // namespace sphdrop

int main(int argc, char** argv) {
  const sphdrop::MpiEnvironment environment(argc, argv);
  const sphdrop::Communicator world(MPI_COMM_WORLD);
  try {
    if (argc != 2) throw std::invalid_argument("usage: write_example_run DIRECTORY");
    sphdrop::write_run(world, argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rank {}: {}\n", world.rank(), error.what());
    return 3;
  }
  return 0;
}
