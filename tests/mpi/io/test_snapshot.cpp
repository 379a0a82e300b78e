// Snapshots on several ranks: content, equality of bytes whatever the distribution, and errors that all ranks hear of.
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>

#include "io/hdf5_file.hpp"
#include "io/output_directory.hpp"
#include "io/provenance.hpp"
#include "io/snapshot.hpp"
#include "io/snapshot_series.hpp"

namespace sphdrop {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Rows whose every value follows from the id, owned as `owner` says, in an order that is not the ids'.
struct TestRows {
  TestRows(const Communicator& communicator, std::int64_t total_rows, const std::function<int(std::int64_t)>& owner)
      : total(total_rows) {
    for (std::int64_t id = total - 1; id >= 0; --id) {
      if (owner(id) == communicator.rank()) ids.push_back(id);
    }
    for (const std::int64_t id : ids) {
      x.push_back(x_of(id));
      y.push_back(y_of(id));
      velocity_x.push_back(-2.0 * x_of(id));
      velocity_y.push_back(1.0 / (1.0 + static_cast<double>(id)));
      material.push_back(id % 2);
    }
  }
  static double x_of(std::int64_t id) { return 1e-3 * std::sqrt(static_cast<double>(id)); }
  static double y_of(std::int64_t id) { return -static_cast<double>(id) / 3.0; }

  SnapshotRows rows() const { return {total, ids, x, y}; }
  std::vector<SnapshotColumn> columns() const {
    return {SnapshotColumn::integer("material", "0 liquid, 1 solid", material),
            SnapshotColumn::vector("velocity", "m/s", "velocity", velocity_x, velocity_y),
            SnapshotColumn::scalar("density", "kg/m3", "density", velocity_y)};
  }

  std::int64_t total;
  std::vector<std::int64_t> ids, material;
  std::vector<double> x, y, velocity_x, velocity_y;
};

SnapshotHeader test_header() {
  return {1.25e-3, 250000, 0x0123456789abcdefULL, "test case", "0.1.0"};
}

class Snapshot : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::path(testing::TempDir()) / "sphdrop_snapshot_").string() + std::to_string(::getpid());
    world_.broadcast(name, 0);
    directory_ = name;
    if (world_.rank() == 0) fs::create_directories(directory_);
    world_.barrier();
  }
  void TearDown() override {
    world_.barrier();
    if (world_.rank() != 0) return;
    ::umount2(directory_.c_str(), MNT_DETACH);
    fs::remove_all(directory_);
  }
  int round_robin(std::int64_t id) const { return static_cast<int>(id % world_.size()); }

  /// Expects SnapshotError on every rank with one text, which is returned, and nothing left behind.
  std::string failure(const fs::path& path, const SnapshotRows& rows, std::span<const SnapshotColumn> columns) {
    const bool existed = fs::exists(path);
    world_.barrier();
    std::string text;
    try {
      write_snapshot(world_, path, test_header(), rows, columns);
    } catch (const SnapshotError& error) {
      text = error.what();
    }
    EXPECT_FALSE(text.empty()) << "no exception";
    std::string of_root = text;
    world_.broadcast(of_root, 0);
    EXPECT_EQ(text, of_root) << "the ranks disagree";
    world_.barrier();
    EXPECT_EQ(fs::exists(path), existed);
    EXPECT_FALSE(fs::exists(path.string() + ".part"));
    return text;
  }

  Communicator world_{MPI_COMM_WORLD};
  fs::path directory_;
};

TEST_F(Snapshot, HoldsEveryRowInTheOrderOfTheIds) {
  const std::int64_t total = 1003;
  // Rank 0 owns nothing if there is another rank: counts of zero are part of the contract.
  const TestRows test(world_, total, [&](std::int64_t id) {
    return world_.size() == 1 ? 0 : 1 + static_cast<int>((id * id / 7) % (world_.size() - 1));
  });
  const auto path = directory_ / "snapshot_000000.vtkhdf";
  write_snapshot(world_, path, test_header(), test.rows(), test.columns());
  EXPECT_FALSE(fs::exists(path.string() + ".part"));

  const auto n = static_cast<std::size_t>(total);
  const Hdf5File file = Hdf5File::open_to_read(path.string());
  const auto reals = [&](const char* name, std::size_t components) {
    std::vector<double> values(n * components);
    const auto dataset = file.open_dataset(name, Hdf5Type::float64);
    EXPECT_EQ(dataset.rows(), total);
    EXPECT_EQ(dataset.components(), static_cast<int>(components));
    dataset.read_rows(0, total, values.data());
    return values;
  };
  const auto integers = [&](const char* name, std::int64_t rows) {
    std::vector<std::int64_t> values(static_cast<std::size_t>(rows));
    file.open_dataset(name, Hdf5Type::int64).read_rows(0, rows, values.data());
    return values;
  };
  const auto points = reals("/VTKHDF/Points", 3);
  const auto velocity = reals("/VTKHDF/PointData/velocity", 3);
  const auto density = reals("/VTKHDF/PointData/density", 1);
  const auto ids = integers("/VTKHDF/PointData/id", total);
  const auto material = integers("/VTKHDF/PointData/material", total);
  const auto connectivity = integers("/VTKHDF/Connectivity", total);
  const auto offsets = integers("/VTKHDF/Offsets", total + 1);
  const auto types = integers("/VTKHDF/Types", total);
  for (std::size_t k = 0; k < n; ++k) {
    const auto id = static_cast<std::int64_t>(k);
    ASSERT_EQ(points[3 * k], TestRows::x_of(id));
    ASSERT_EQ(points[3 * k + 1], TestRows::y_of(id));
    ASSERT_EQ(points[3 * k + 2], 0.0);
    ASSERT_EQ(velocity[3 * k], -2.0 * TestRows::x_of(id));
    ASSERT_EQ(velocity[3 * k + 1], 1.0 / (1.0 + static_cast<double>(id)));
    ASSERT_EQ(velocity[3 * k + 2], 0.0);
    ASSERT_EQ(density[k], 1.0 / (1.0 + static_cast<double>(id)));
    ASSERT_EQ(ids[k], id);
    ASSERT_EQ(material[k], id % 2);
    ASSERT_EQ(connectivity[k], id);
    ASSERT_EQ(offsets[k], id);
    ASSERT_EQ(types[k], 1);
  }
  EXPECT_EQ(offsets[n], total);
  EXPECT_EQ(integers("/VTKHDF/NumberOfPoints", 1)[0], total);
  EXPECT_EQ(integers("/VTKHDF/NumberOfCells", 1)[0], total);
  EXPECT_EQ(integers("/VTKHDF/NumberOfConnectivityIds", 1)[0], total);
  EXPECT_EQ(file.read_real_attribute("/", "time"), 1.25e-3);
  EXPECT_EQ(file.read_integer_attribute("/", "step"), 250000);
  EXPECT_EQ(file.read_text_attribute("/", "state_hash"), "0123456789abcdef");
  EXPECT_EQ(file.read_text_attribute("/", "name"), "test case");
  EXPECT_EQ(file.read_text_attribute("/VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/PointData/velocity", "unit"), "m/s");
  EXPECT_EQ(file.read_text_attribute("/VTKHDF/PointData/material", "description"), "0 liquid, 1 solid");
}

TEST_F(Snapshot, BytesDependNeitherOnTheNumberOfRanksNorOnWhoOwnsWhat) {
  const std::int64_t total = 2500;
  const auto path_for = [&](int ranks, int way) {
    return directory_ / ("ranks_" + std::to_string(ranks) + "_" + std::to_string(way) + ".vtkhdf");
  };
  for (int ranks = 1; ranks <= world_.size(); ++ranks) {
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, world_.rank() < ranks ? 0 : MPI_UNDEFINED, world_.rank(), &some);
    if (some != MPI_COMM_NULL) {
      const Communicator part(some);
      const std::array<std::function<int(std::int64_t)>, 3> ways = {
          [&](std::int64_t id) { return static_cast<int>(id % ranks); },
          [&](std::int64_t id) { return static_cast<int>(id * ranks / total); },
          [&](std::int64_t) { return ranks - 1; }};
      for (std::size_t way = 0; way < ways.size(); ++way) {
        const TestRows test(part, total, ways[way]);
        write_snapshot(part, path_for(ranks, static_cast<int>(way)), test_header(), test.rows(), test.columns());
      }
    }
    if (some != MPI_COMM_NULL) MPI_Comm_free(&some);
    world_.barrier();
  }
  const std::string expected = bytes_of(path_for(1, 0));
  EXPECT_GT(expected.size(), 2500U * 89) << "89 bytes a row";
  for (int ranks = 1; ranks <= world_.size(); ++ranks) {
    for (int way = 0; way < 3; ++way) EXPECT_TRUE(bytes_of(path_for(ranks, way)) == expected) << ranks << ' ' << way;
  }
}

TEST_F(Snapshot, OfNoRowsOrFewerThanRanksIsWhole) {
  for (const std::int64_t total : {0, 1}) {
    const TestRows test(world_, total, [](std::int64_t) { return 0; });
    const auto path = directory_ / ("few_" + std::to_string(total));
    write_snapshot(world_, path, test_header(), test.rows(), test.columns());
    EXPECT_EQ(Hdf5File::open_to_read(path.string()).open_dataset("/VTKHDF/Points", Hdf5Type::float64).rows(), total);
  }
}

TEST_F(Snapshot, WrongRowsAreRefusedOnAllRanks) {
  const auto path = directory_ / "snapshot_000000.vtkhdf";
  const int last = world_.size() - 1;
  const auto owner = [&](std::int64_t id) { return round_robin(id); };

  TestRows twice(world_, 100, owner);
  if (world_.rank() == last) twice.ids.back() = twice.ids.front();
  EXPECT_NE(failure(path, twice.rows(), twice.columns()).find("held twice"), std::string::npos);

  TestRows outside(world_, 100, owner);
  if (world_.rank() == last) outside.ids.back() = 100;
  EXPECT_NE(failure(path, outside.rows(), outside.columns()).find("100 is not within 0 ... 99"), std::string::npos);

  TestRows missing(world_, 100, owner);
  auto rows = missing.rows();
  rows.total = 101;
  EXPECT_NE(failure(path, rows, missing.columns()).find("100 rows together, but 101"), std::string::npos);

  const TestRows good(world_, 100, owner);
  auto columns = good.columns();
  if (world_.rank() == last) columns[2].components[0] = std::span(good.velocity_y).first(1);
  EXPECT_NE(failure(path, good.rows(), columns).find("'density': 1 values for"), std::string::npos);
  columns = good.columns();
  columns[0].name = "id";
  EXPECT_NE(failure(path, good.rows(), columns).find("named 'id'"), std::string::npos);
}

TEST_F(Snapshot, AFolderThatIsNotThereIsReportedOnAllRanks) {
  const TestRows test(world_, 10, [&](std::int64_t id) { return round_robin(id); });
  const std::string text = failure(directory_ / "missing" / "snapshot_000000.vtkhdf", test.rows(), test.columns());
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
}

TEST_F(Snapshot, FailureInTheLastStepLeavesNothing) {
  const auto path = directory_ / "snapshot_000000.vtkhdf";
  if (world_.rank() == 0) fs::create_directories(path / "not_empty");
  world_.barrier();
  const TestRows test(world_, 10, [&](std::int64_t id) { return round_robin(id); });
  EXPECT_NE(failure(path, test.rows(), test.columns()).find("renaming"), std::string::npos);
}

TEST_F(Snapshot, AFullDiskLeavesTheOldFileAndLetsTheRunGoOn) {
  std::int64_t mounted = 0;
  if (world_.rank() == 0) mounted = ::mount("tmpfs", directory_.c_str(), "tmpfs", 0, "size=3m") == 0 ? 1 : 0;
  mounted = world_.max(mounted);
  if (mounted == 0) GTEST_SKIP() << "no right to mount a small file system";
  const auto path = directory_ / "snapshot_000000.vtkhdf";
  const TestRows small(world_, 1000, [&](std::int64_t id) { return round_robin(id); });
  write_snapshot(world_, path, test_header(), small.rows(), small.columns());
  const std::string before = bytes_of(path);
  world_.barrier();

  const TestRows large(world_, 100000, [&](std::int64_t id) { return round_robin(id); });
  const std::string text = failure(path, large.rows(), large.columns());
  EXPECT_NE(text.find("No space left on device"), std::string::npos) << text;
  EXPECT_TRUE(bytes_of(path) == before);
  world_.barrier();

  write_snapshot(world_, path, test_header(), small.rows(), small.columns());
  EXPECT_TRUE(bytes_of(path) == before);
}

TEST_F(Snapshot, SeriesKeepsItsIndexAndGoesOnAfterARestart) {
  const TestRows test(world_, 10, [&](std::int64_t id) { return round_robin(id); });
  const auto write_at = [&](SnapshotSeries& series, double time) {
    SnapshotHeader header = test_header();
    header.time = time;
    return series.write(header, test.rows(), test.columns()).filename().string();
  };
  SnapshotSeries series(world_, directory_);
  EXPECT_EQ(write_at(series, 0.0), "snapshot_000000.vtkhdf");
  EXPECT_EQ(write_at(series, 1e-4), "snapshot_000001.vtkhdf");
  EXPECT_EQ(write_at(series, 2e-4), "snapshot_000002.vtkhdf");
  const std::string start =
      "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
      "    {\"name\": \"snapshot_000000.vtkhdf\", \"time\": 0},\n"
      "    {\"name\": \"snapshot_000001.vtkhdf\", \"time\": 0.0001}";
  const auto index = directory_ / "snapshots.vtkhdf.series";
  world_.barrier();
  EXPECT_EQ(bytes_of(index), start + ",\n    {\"name\": \"snapshot_000002.vtkhdf\", \"time\": 0.0002}\n  ]\n}\n");

  world_.barrier();
  SnapshotSeries resumed(world_, directory_);
  EXPECT_EQ(resumed.count(), 3);
  EXPECT_EQ(write_at(resumed, 1.5e-4), "snapshot_000002.vtkhdf") << "the one at 2e-4 is of the abandoned future";
  EXPECT_EQ(resumed.count(), 3);
  world_.barrier();
  EXPECT_EQ(bytes_of(index), start + ",\n    {\"name\": \"snapshot_000002.vtkhdf\", \"time\": 0.00015}\n  ]\n}\n");
}

TEST_F(Snapshot, UnreadableOldSnapshotStopsTheSeriesOnAllRanks) {
  if (world_.rank() == 0) std::ofstream(directory_ / "snapshot_000000.vtkhdf") << "not HDF5";
  world_.barrier();
  EXPECT_THROW(SnapshotSeries(world_, directory_), SnapshotError);
}

TEST_F(Snapshot, OutputDirectoryIsRefusedOnAllRanksAlike) {
  prepare_output_directory(world_, directory_ / "deep" / "er");
  EXPECT_TRUE(fs::is_directory(directory_ / "deep" / "er"));
  if (world_.rank() == 0) std::ofstream(directory_ / "file") << "x";
  world_.barrier();
  std::string text;
  try {
    prepare_output_directory(world_, directory_ / "file");
  } catch (const OutputDirectoryError& error) {
    text = error.what();
  }
  EXPECT_NE(text.find("is a file; remove it"), std::string::npos) << text;
}

TEST_F(Snapshot, RunRecordThatCannotBeWrittenIsToldOnAllRanks) {
  const RunRecord record(world_, {"sphdrop"});
  EXPECT_THROW(record.write(world_, directory_ / "missing"), RunRecordError);
}

TEST_F(Snapshot, RunRecordSaysWhatIsKnown) {
  RunRecord record(world_, {"sphdrop", "a \"quoted\" case.cfg"});
  record.write(world_, directory_);
  world_.barrier();
  EXPECT_NE(bytes_of(directory_ / "run.json").find("\"status\": \"running\""), std::string::npos);
  world_.barrier();
  record.set("repartitions", std::int64_t{3});
  record.finish("completed", 0xfedcULL);
  record.write(world_, directory_);
  world_.barrier();
  const std::string text = bytes_of(directory_ / "run.json");
  for (const std::string& part :
       {std::string("\"status\": \"completed\""), std::string("\"state_hash\": \"000000000000fedc\""),
        std::string(R"("command_line": ["sphdrop", "a \"quoted\" case.cfg"])"), std::string("\"repartitions\": 3"),
        "\"ranks\": " + std::to_string(world_.size()), std::string("\"mpi\": \"Open MPI"),
        std::string("\"wall_time_seconds\": "), "\"version\": \"" + build_info().version + "\"",
        "\"vector_width\": " + std::to_string(build_info().vector_width)}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
}

}  // namespace
}  // namespace sphdrop
