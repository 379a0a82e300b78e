// What writing takes beside the columns: a few bytes a row, where a copy of the columns would be eight bytes a column.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <numeric>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "io/rows_by_id.hpp"
#include "io/snapshot.hpp"

namespace {

std::atomic<std::size_t> live_bytes = 0, most_bytes = 0;

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t now = live_bytes += ::malloc_usable_size(memory);
  std::size_t most = most_bytes;
  while (now > most && !most_bytes.compare_exchange_weak(most, now)) {
  }
  return memory;
}

void release(void* memory) {
  if (memory == nullptr) return;
  live_bytes -= ::malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

// All of C++'s memory in this program, and so all of ours.
void* operator new(std::size_t bytes) {
  return counted(std::malloc(std::max(bytes, std::size_t{1})));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}

namespace sphdrop {
namespace {

namespace fs = std::filesystem;

// As the address sanitizer does, for a while; g++ and clang++ tell of it in their own ways.
#ifdef __has_feature
constexpr bool keeps_what_is_freed = __has_feature(address_sanitizer);
#elif defined(__SANITIZE_ADDRESS__)
constexpr bool keeps_what_is_freed = true;
#else
constexpr bool keeps_what_is_freed = false;
#endif

// Enough for 16 parts on one rank and for four on several.
constexpr std::int64_t rows_of_rank = 16 * RowsById::usual_part_rows(1);
static_assert(rows_of_rank == 4 * RowsById::usual_part_rows(2));

/// The most that C++ has held at a time during `action` beyond what it held before, bytes.
template <class Action>
std::size_t most_memory_of(Action&& action) {
  const std::size_t before = live_bytes;
  most_bytes = before;
  action();
  return most_bytes - before;
}

/// The most that this process has had resident so far, bytes.
std::size_t peak_resident() {
  struct rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
}

class WritingMemory : public testing::Test {
 protected:
  WritingMemory() : ids_(static_cast<std::size_t>(rows_of_rank)), values_(ids_.size()) {
    // Blocks that the ranks own in turn, so that all but a share of the rows travels.
    constexpr std::int64_t block = 1000;
    for (std::int64_t k = 0; k < rows_of_rank; ++k)
      ids_[static_cast<std::size_t>(k)] = (k / block * world_.size() + world_.rank()) * block + k % block;
    // The last block is shorter on all ranks.
    const std::int64_t whole = rows_of_rank / block * block, rest = rows_of_rank - whole;
    for (std::int64_t k = whole; k < rows_of_rank; ++k)
      ids_[static_cast<std::size_t>(k)] = whole * world_.size() + world_.rank() * rest + k - whole;
    std::iota(values_.begin(), values_.end(), 1.0);
    std::string name = (fs::path(testing::TempDir()) / "sphdrop_memory_").string() + std::to_string(::getpid());
    world_.broadcast(name, 0);
    directory_ = name;
    if (world_.rank() == 0) fs::create_directories(directory_);
    world_.barrier();
  }
  ~WritingMemory() override {
    world_.barrier();
    std::error_code ignored;
    if (world_.rank() == 0) fs::remove_all(directory_, ignored);
  }
  void expect_little(const char* what, std::size_t bytes, double alone, double together) const {
    EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(rows_of_rank), world_.size() == 1 ? alone : together)
        << what << ", bytes a row beside " << columns * sizeof(double) << " of the columns";
  }

  static constexpr std::size_t columns = 10;
  Communicator world_{MPI_COMM_WORLD};
  std::vector<std::int64_t> ids_;
  std::vector<double> values_;  // of every column
  fs::path directory_;
};

TEST_F(WritingMemory, OfACheckpointIsLittle) {
  CheckpointTable table{"rows", rows_of_rank * world_.size(), ids_, {}};
  for (std::size_t k = 0; k < columns; ++k)
    table.columns.push_back({"column_" + std::to_string(k), "m", "a quantity", values_});
  const std::size_t resident_before = peak_resident();
  fs::path path;
  const std::size_t bytes = most_memory_of([&] {
    path = write_checkpoint(world_, directory_, {"test", "0", "0", 0, 1, 0, ""}, {&table, 1}, {});
  });
  EXPECT_GT(fs::file_size(path), columns * sizeof(double) * static_cast<std::size_t>(rows_of_rank));
  expect_little("C++", bytes, 8, 24);
  // HDF5's and MPI's too, which are some megabytes however many rows there are.
  if (!keeps_what_is_freed) expect_little("resident", peak_resident() - resident_before, 24, 40);
}

TEST_F(WritingMemory, OfASnapshotIsLittle) {
  std::vector<SnapshotColumn> all;
  for (std::size_t k = 0; k < columns / 2; ++k)
    all.push_back(SnapshotColumn::vector("vector_" + std::to_string(k), "m", "a quantity", values_, values_));
  const std::size_t bytes = most_memory_of([&] {
    write_snapshot(world_, directory_ / "snapshot", {0, 1, 0, "test", "0"},
                   {rows_of_rank * world_.size(), ids_, values_, values_}, all);
  });
  expect_little("C++", bytes, 8, 24);
}

}  // namespace
}  // namespace sphdrop
