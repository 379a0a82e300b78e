// What a checkpoint costs: writing it (all in: sealed, flushed, read back, renamed), verifying it and reading it, for
// 10^4 and 10^6 particles of 20 columns. Run under mpirun; argv[1] is the directory to write to (default: the current).
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "io/rows_by_id.hpp"

namespace sphdrop {
namespace {

constexpr int column_count = 20;

/// The most memory this process has had so far, MiB.
double peak_memory() {
  struct rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

class Particles {
 public:
  Particles(const Communicator& world, std::int64_t total) : total_(total), columns_(column_count) {
    // In blocks with every tenth row elsewhere, much as a run deals them out.
    const RowBlock block = RowBlock::of_rank(total, world.rank(), world.size());
    for (std::int64_t id = 0; id < total; ++id) {
      const bool is_stray = id % 10 == 0;
      if (is_stray ? (id / 10) % world.size() == world.rank() : id >= block.first && id < block.end) ids_.push_back(id);
    }
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      for (const std::int64_t id : ids_)
        columns_[column].push_back(static_cast<double>(id) / (1.0 + static_cast<double>(column)));
    }
  }
  CheckpointTable table() const {
    CheckpointTable table{"particles", total_, ids_, {}};
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      table.columns.push_back({fmt::format("column_{:02}", k), "m", "a quantity", columns_[k]});
    }
    return table;
  }

 private:
  std::int64_t total_;
  std::vector<std::int64_t> ids_;
  std::vector<std::vector<double>> columns_;
};

/// Seconds of the slowest rank, the best of three times.
template <class Action>
double seconds(const Communicator& world, Action&& action) {
  double best = 1e300;
  for (int repeat = 0; repeat < 3; ++repeat) {
    world.barrier();
    const auto start = std::chrono::steady_clock::now();
    action();
    const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::min(best, world.max(taken));
  }
  return best;
}

void measure(const Communicator& world, const std::filesystem::path& directory, std::int64_t total) {
  const Particles particles(world, total);
  const std::vector<CheckpointTable> tables = {particles.table()};
  const std::vector<CheckpointNumbers> numbers = {{"time_step", "s", "of the last step", {1e-8}}};
  const CheckpointHeader header = {"benchmark", "0", "0", 0.0, total, 0, std::string(5000, 'x')};
  const double memory_before = peak_memory();
  std::filesystem::path path;
  const double writing = seconds(world, [&] { path = write_checkpoint(world, directory, header, tables, numbers, 2); });
  const double memory = world.max(peak_memory() - memory_before);
  const double verifying = seconds(world, [&] { verify_checkpoint(world, path); });
  const double reading = seconds(world, [&] { read_checkpoint(world, path); });
  if (world.rank() != 0) return;
  const double size = static_cast<double>(std::filesystem::file_size(path)) / 0x1p20;
  fmt::print("{:>8} particles, {:6.1f} MiB, {} ranks: write {:.3f} s, verify {:.3f} s, read {:.3f} s; ", total, size,
             world.size(), writing, verifying, reading);
  fmt::print("{:.0f} MiB more memory on a rank\n", memory);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace sphdrop

int main(int argc, char** argv) {
  const sphdrop::MpiEnvironment environment(argc, argv);
  const sphdrop::Communicator world(MPI_COMM_WORLD);
  try {
    for (const std::int64_t total : {10'000, 1'000'000}) sphdrop::measure(world, argc > 1 ? argv[1] : ".", total);
  } catch (const std::exception& error) {
    fmt::print(stderr, "rank {}: {}\n", world.rank(), error.what());
    return 1;
  }
  return 0;
}
