#pragma once
// A state whose every bit follows from its ids, filed and read back by the tests of checkpoints.

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"

namespace sphdrop::test {

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// Among the ids 0 ... 15: both zeros, both infinities, NaNs with payloads, the smallest and the largest numbers.
inline double unusual_value(std::int64_t id) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array special = {0.0,
                                  -0.0,
                                  Limits::infinity(),
                                  -Limits::infinity(),
                                  std::bit_cast<double>(0x7ff8000000000001ULL),
                                  std::bit_cast<double>(0xfff8dead0000beefULL),
                                  std::bit_cast<double>(0x7ff0000000000001ULL),  // signalling
                                  Limits::denorm_min(),
                                  Limits::max(),
                                  Limits::lowest(),
                                  Limits::min()};
  const auto place = static_cast<std::size_t>(id % 16);
  return place < special.size() ? special[place] : std::sqrt(static_cast<double>(id));
}

inline double value_of(const std::string& table, const std::string& column, std::int64_t id) {
  if (column == "unusual") return unusual_value(id);
  const double scale = table == "fluid" ? 1.0 : -7.0;
  return scale * (static_cast<double>(id) + (column == "x" ? 0.25 : 1.0 / 3.0));
}

/// This rank's rows of two tables: the liquid's ids from 0 on, the solid's behind them.
class SampleState {
 public:
  using Owner = std::function<int(std::int64_t)>;

  SampleState(const Communicator& communicator, std::int64_t fluid, std::int64_t solid, const Owner& owner)
      : rows_{Rows("fluid", 0, fluid, communicator.rank(), owner),
              Rows("solid", fluid, fluid + solid, communicator.rank(), owner)} {}

  std::vector<CheckpointTable> tables() const {
    std::vector<CheckpointTable> all;
    for (const Rows& rows : rows_) {
      all.push_back({rows.name,
                     rows.end - rows.begin,
                     rows.ids,
                     {{"x", "m", "position", rows.x},
                      {"density", "kg/m3", "density at n - 1/2", rows.density},
                      {"unusual", "1", "anything", rows.unusual}}});
    }
    return all;
  }

 private:
  struct Rows {
    Rows(std::string table, std::int64_t first, std::int64_t last, int rank, const Owner& owner)
        : name(std::move(table)), begin(first), end(last) {
      for (std::int64_t id = end - 1; id >= begin; --id) {
        if (owner(id) != rank) continue;
        ids.push_back(id);
        x.push_back(value_of(name, "x", id));
        density.push_back(value_of(name, "density", id));
        unusual.push_back(value_of(name, "unusual", id));
      }
    }
    std::string name;
    std::int64_t begin, end;
    std::vector<std::int64_t> ids;
    std::vector<double> x, density, unusual;
  };
  std::array<Rows, 2> rows_;
};

inline CheckpointHeader sample_header(std::int64_t step = 250000) {
  return {"test case",
          "0.1.0",
          "55566bd",
          1e-8 * static_cast<double>(step),
          step,
          0x0123456789abcdefULL,
          "name = \"test case\"\n\n[resolution]\nparticle_spacing = 1e-05 # \xc2\xb5m, \"quoted\"\n"};
}

inline std::vector<CheckpointNumbers> sample_numbers() {
  return {{"time_step", "s", "of the last step", {1.25e-8}},
          {"contact_impulse", "N s/m", "up to now", {unusual_value(1), unusual_value(5), 3.0}},
          {"nothing", "1", "no numbers at all", {}}};
}

inline std::filesystem::path write_sample(const Communicator& communicator, const std::filesystem::path& directory,
                                          std::int64_t step = 250000, int keep = 2, std::int64_t fluid = 40,
                                          std::int64_t solid = 23) {
  const int ranks = communicator.size();
  const SampleState state(communicator, fluid, solid, [&](std::int64_t id) { return static_cast<int>(id % ranks); });
  return write_checkpoint(communicator, directory, sample_header(step), state.tables(), sample_numbers(), keep);
}

inline bool same_bits_all(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double one, double other) {
    return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
  });
}

/// Whether a checkpoint of write_sample() is all there, bit for bit, as far as this rank has it.
inline ::testing::AssertionResult is_sample(const Checkpoint& found, std::int64_t step = 250000,
                                            std::int64_t fluid = 40, std::int64_t solid = 23) {
  const auto differs = [](const std::string& what) { return ::testing::AssertionFailure() << what << " differs"; };
  const CheckpointHeader header = sample_header(step);
  const CheckpointHeader& h = found.header;
  if (h.name != header.name || h.version != header.version || h.git_commit != header.git_commit) return differs("name");
  if (h.time != header.time || h.step != step || h.state_hash != header.state_hash)
    return differs("time, step or hash");
  if (h.case_text != header.case_text) return differs("case");
  if (found.numbers.size() != 3 || found.tables.size() != 2) return differs("the number of groups");
  for (const CheckpointNumbers& entry : sample_numbers()) {
    if (!same_bits_all(found.numbers_of(entry.name), entry.values)) return differs(entry.name);
  }
  for (const Checkpoint::Table& table : found.tables) {
    if (table.total_rows != (table.name == "fluid" ? fluid : solid)) return differs(table.name);
    if (table.columns.size() != 3) return differs(table.name + "'s columns");
    for (const Checkpoint::Column& column : table.columns) {
      std::vector<double> expected;
      for (std::int64_t row = 0; row < table.row_count; ++row) {
        expected.push_back(value_of(table.name, column.name, table.first_id + row));
      }
      if (!same_bits_all(column.values, expected)) return differs(table.name + "/" + column.name);
      if (column.unit != (column.name == "x" ? "m" : column.name == "density" ? "kg/m3" : "1")) return differs("unit");
    }
  }
  return ::testing::AssertionSuccess();
}

/// A directory of its own, seen by all ranks; a test may mount something over it.
class CheckpointTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name =
        (std::filesystem::path(testing::TempDir()) / "sphdrop_checkpoint_").string() + std::to_string(::getpid());
    world_.broadcast(name, 0);
    directory_ = name;
    if (world_.rank() == 0) std::filesystem::create_directories(directory_);
    world_.barrier();
  }
  void TearDown() override {
    world_.barrier();
    if (world_.rank() != 0) return;
    ::umount2(directory_.c_str(), MNT_DETACH);
    std::filesystem::remove_all(directory_);
  }

  /// The text of the CheckpointError that `action` throws, which must be the same on all ranks; "" without one.
  std::string failure(const std::function<void()>& action) {
    std::string text;
    try {
      action();
    } catch (const CheckpointError& error) {
      text = error.what();
    }
    std::string of_root = text;
    world_.broadcast(of_root, 0);
    EXPECT_EQ(text, of_root) << "the ranks disagree";
    world_.barrier();
    return text;
  }
  std::string refusal(const std::filesystem::path& path) {
    return failure([&] { read_checkpoint(world_, path); });
  }
  /// Does what only one rank is to do, while the others wait.
  void on_root(const std::function<void()>& action) {
    world_.barrier();
    if (world_.rank() == 0) action();
    world_.barrier();
  }
  /// Runs `action` on the first `ranks` ranks, while the others wait.
  void on_first(int ranks, const std::function<void(const Communicator&)>& action) {
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(world_.handle(), world_.rank() < ranks ? 0 : MPI_UNDEFINED, world_.rank(), &some);
    if (some != MPI_COMM_NULL) {
      action(Communicator(some));
      MPI_Comm_free(&some);
    }
    world_.barrier();
  }
  std::vector<std::string> names_in_directory() {
    world_.barrier();
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    world_.barrier();
    return names;
  }

  Communicator world_{MPI_COMM_WORLD};
  std::filesystem::path directory_;
};

}  // namespace sphdrop::test
