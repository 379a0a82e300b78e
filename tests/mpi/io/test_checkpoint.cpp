// Checkpoints on several ranks: what is read is what was written, bit for bit; the bytes of the file; which are kept.
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <filesystem>
#include <string>

#include "checkpoint_samples.hpp"
#include "io/hdf5_file.hpp"

namespace sphdrop {
namespace {

namespace fs = std::filesystem;
using Checkpoints = test::CheckpointTest;
using test::bytes_of;
using test::is_sample;
using test::SampleState;
using test::write_sample;

TEST_F(Checkpoints, GiveBackEveryBitOnAnyNumberOfRanks) {
  for (int writers = 1; writers <= world_.size(); ++writers) {
    fs::path path;
    on_first(writers, [&](const Communicator& some) { path = write_sample(some, directory_); });
    path = directory_ / "checkpoint_000000250000.h5";
    for (int readers = 1; readers <= world_.size(); ++readers) {
      on_first(readers, [&](const Communicator& some) {
        const Checkpoint found = read_checkpoint(some, path);
        EXPECT_TRUE(is_sample(found)) << writers << " writers, " << readers << " readers";
        for (const Checkpoint::Table& table : found.tables) {
          EXPECT_EQ(some.sum(table.row_count), table.total_rows);
          EXPECT_GE(table.row_count, table.total_rows / readers);
          EXPECT_LE(table.row_count, table.total_rows / readers + 1);
          const std::vector<std::int64_t> starts = some.all_gather(std::span<const std::int64_t>(&table.first_id, 1));
          EXPECT_EQ(starts[0], table.name == "fluid" ? 0 : 40);
          EXPECT_TRUE(std::is_sorted(starts.begin(), starts.end()));
        }
      });
    }
  }
}

TEST_F(Checkpoints, BytesDependNeitherOnTheNumberOfRanksNorOnWhoOwnsWhat) {
  const std::int64_t fluid = 9000, solid = 40000;  // 1.2 MB: more than one block of the checksum
  const std::int64_t total = fluid + solid;
  std::string expected;
  for (int ranks = 1; ranks <= world_.size(); ++ranks) {
    const std::array<SampleState::Owner, 3> ways = {
        [&](std::int64_t id) { return static_cast<int>(id % ranks); },
        [&](std::int64_t id) { return static_cast<int>((total - 1 - id) * ranks / total); },
        [&](std::int64_t) { return ranks - 1; }};
    for (const SampleState::Owner& owner : ways) {
      on_first(ranks, [&](const Communicator& some) {
        const SampleState state(some, fluid, solid, owner);
        auto numbers = test::sample_numbers();
        if (some.rank() > 0) numbers[0].values[0] = 17;  // those of rank 0 count
        write_checkpoint(some, directory_, test::sample_header(), state.tables(), numbers);
      });
      const std::string bytes = bytes_of(directory_ / "checkpoint_000000250000.h5");
      if (expected.empty()) expected = bytes;
      EXPECT_TRUE(bytes == expected) << ranks << " ranks";
      world_.barrier();
    }
  }
  EXPECT_GT(expected.size(), static_cast<std::size_t>(total) * 24);
  EXPECT_TRUE(is_sample(read_checkpoint(world_, directory_ / "checkpoint_000000250000.h5"), 250000, fluid, solid));
}

TEST_F(Checkpoints, WithoutRowsAreWhole) {
  for (const auto& [fluid, solid] : {std::pair(0, 0), std::pair(0, 1), std::pair(2, 0)}) {
    const fs::path path = write_sample(world_, directory_, 250000, 2, fluid, solid);
    EXPECT_TRUE(is_sample(read_checkpoint(world_, path), 250000, fluid, solid)) << fluid << ' ' << solid;
    world_.barrier();
  }
  // No tables, no numbers, no texts.
  const fs::path path = write_checkpoint(world_, directory_, {}, {}, {});
  const Checkpoint found = read_checkpoint(world_, path);
  EXPECT_EQ(path.filename(), "checkpoint_000000000000.h5");
  EXPECT_TRUE(found.tables.empty() && found.numbers.empty() && found.header.case_text.empty());
}

TEST_F(Checkpoints, SayWhatTheyLack) {
  const Checkpoint found = read_checkpoint(world_, write_sample(world_, directory_));
  EXPECT_EQ(found.numbers_of("time_step"), std::vector<double>{1.25e-8});
  EXPECT_NE(failure([&] { found.table("gas"); }).find("000250000.h5 lacks /gas"), std::string::npos);
  EXPECT_NE(failure([&] { found.column("fluid", "colour"); }).find("lacks /fluid/colour"), std::string::npos);
  EXPECT_NE(failure([&] { found.numbers_of("seed"); }).find("lacks /run/seed"), std::string::npos);
}

TEST_F(Checkpoints, WrongArgumentsAreRefusedOnAllRanks) {
  const SampleState state(world_, 40, 23, [&](std::int64_t id) { return static_cast<int>(id % world_.size()); });
  const auto good = state.tables();
  const bool last = world_.rank() == world_.size() - 1;
  const auto refused = [&](const std::vector<CheckpointTable>& tables, const CheckpointHeader& header,
                           const std::vector<CheckpointNumbers>& numbers, int keep, const std::string& words) {
    const std::string text = failure([&] { write_checkpoint(world_, directory_, header, tables, numbers, keep); });
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_TRUE(names_in_directory().empty());
  };
  const auto refused_tables = [&](const std::vector<CheckpointTable>& tables, const std::string& words) {
    refused(tables, test::sample_header(), test::sample_numbers(), 2, words);
  };

  std::vector<std::int64_t> ids = good[1].ids.joined();
  auto tables = good;
  tables[1].ids = ids;
  if (last) ids.back() = ids.front();
  refused_tables(tables, "is held twice");
  if (last) ids.front() = 64;
  refused_tables(tables, "the row id 64 is not within");
  if (last) ids.back() = -2;
  refused_tables(tables, "there are no 23 rows from id -2 on");
  tables = good;
  tables[0].total_rows = 41;
  refused_tables(tables, "40 rows together, but 41");
  tables = good;
  const std::vector<double> one(1);
  if (last) tables[0].columns[1].values = one;
  refused_tables(tables, "'fluid/density': 1 values for");
  tables = good;
  tables[0].columns[1].name = "x";
  refused_tables(tables, "the name 'x' of a column is taken");
  tables = good;
  tables[1].name = "run";
  refused_tables(tables, "the name 'run' of a table is taken");
  tables[1].name = "a/b";
  refused_tables(tables, "'a/b' is no name for a table");

  CheckpointHeader header = test::sample_header();
  header.case_text += '\0';
  refused(good, header, {}, 2, "a text of the header holds a null byte");
  header = test::sample_header(-1);
  refused(good, header, {}, 2, "the step -1 is negative");
  refused(good, test::sample_header(), {}, 0, "0 checkpoints cannot be kept");
  refused(good, test::sample_header(), {{"a", "1", "", {}}, {"a", "1", "", {}}}, 2, "'a' of a set of numbers is taken");
}

TEST_F(Checkpoints, NewestAreKept) {
  using Names = std::vector<std::string>;
  const Names others = {"checkpoint_000000000050.h5x", "checkpoint_100.h5", "notes.txt"};
  on_root([&] {
    for (const std::string& name : others) test::write_bytes(directory_ / name, "not ours");
    test::write_bytes(directory_ / "checkpoint_000000000060.h5.part", "left by a crash");
  });
  const auto with_others = [&](Names names) {
    names.insert(names.end(), others.begin(), others.end());
    std::sort(names.begin(), names.end());
    return names;
  };
  for (const std::int64_t step : {100, 200, 300}) write_sample(world_, directory_, step);
  EXPECT_EQ(names_in_directory(), with_others({"checkpoint_000000000200.h5", "checkpoint_000000000300.h5"}));
  write_sample(world_, directory_, 400, 3);
  EXPECT_EQ(names_in_directory(),
            with_others({"checkpoint_000000000200.h5", "checkpoint_000000000300.h5", "checkpoint_000000000400.h5"}));
  write_sample(world_, directory_, 250, 3);
  EXPECT_EQ(names_in_directory(), with_others({"checkpoint_000000000200.h5", "checkpoint_000000000250.h5"}))
      << "the later ones are of a future that was given up";
  write_sample(world_, directory_, 1234567890123, 1);
  EXPECT_EQ(names_in_directory(), with_others({"checkpoint_1234567890123.h5"}));
  EXPECT_EQ(find_checkpoints(directory_), std::vector<fs::path>{directory_ / "checkpoint_1234567890123.h5"});
  EXPECT_TRUE(find_checkpoints(directory_ / "missing").empty());
}

TEST_F(Checkpoints, LatestFallsBackToTheOneBefore) {
  for (const std::int64_t step : {100, 200, 300, 400}) write_sample(world_, directory_, step, 4);
  EXPECT_EQ(find_checkpoints(directory_).front().filename(), "checkpoint_000000000400.h5");
  LatestCheckpoint latest = read_latest_checkpoint(world_, directory_);
  EXPECT_TRUE(is_sample(latest.checkpoint, 400));
  EXPECT_TRUE(latest.refused.empty());

  on_root([&] {
    std::string bytes = bytes_of(directory_ / "checkpoint_000000000400.h5");
    bytes[bytes.size() / 2] ^= 1;
    test::write_bytes(directory_ / "checkpoint_000000000400.h5", bytes);
    fs::resize_file(directory_ / "checkpoint_000000000300.h5", 5000);
  });
  latest = read_latest_checkpoint(world_, directory_);
  EXPECT_TRUE(is_sample(latest.checkpoint, 200));
  ASSERT_EQ(latest.refused.size(), 2U);
  EXPECT_NE(latest.refused[0].find("000400.h5 is damaged: the checksum of its bytes is"), std::string::npos);
  EXPECT_NE(latest.refused[1].find("000300.h5 is truncated: 5000 of "), std::string::npos);

  on_root([&] {
    for (const char* name : {"checkpoint_000000000200.h5", "checkpoint_000000000100.h5"})
      test::write_bytes(directory_ / name, "");
  });
  const std::string none = failure([&] { read_latest_checkpoint(world_, directory_); });
  for (const char* words :
       {"000400.h5 is damaged", "000300.h5 is truncated", "000200.h5 is empty", "000100.h5 is empty"})
    EXPECT_NE(none.find(words), std::string::npos) << none;
  EXPECT_NE(failure([&] { read_latest_checkpoint(world_, directory_ / "missing"); }).find("there is no checkpoint in"),
            std::string::npos);
}

TEST_F(Checkpoints, ThatCannotBeWrittenLeaveTheOldOne) {
  const std::string text = failure([&] { write_sample(world_, directory_ / "missing"); });
  EXPECT_NE(text.find("could not be written"), std::string::npos) << text;
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;

  // The last step, the renaming, fails.
  write_sample(world_, directory_, 100, 1);
  const std::string before = bytes_of(directory_ / "checkpoint_000000000100.h5");
  on_root([&] { fs::create_directories(directory_ / "checkpoint_000000000200.h5" / "not_empty"); });
  EXPECT_NE(failure([&] { write_sample(world_, directory_, 200, 1); }).find("renaming"), std::string::npos);
  EXPECT_TRUE(bytes_of(directory_ / "checkpoint_000000000100.h5") == before);
  EXPECT_EQ(names_in_directory().size(), 2U) << "something was left behind";
}

TEST_F(Checkpoints, AFullDiskLeavesTheOldOneAndLetsTheRunGoOn) {
  std::int64_t mounted = 0;
  if (world_.rank() == 0) mounted = ::mount("tmpfs", directory_.c_str(), "tmpfs", 0, "size=3m") == 0 ? 1 : 0;
  if (world_.max(mounted) == 0) GTEST_SKIP() << "no right to mount a small file system";
  const fs::path old = write_sample(world_, directory_, 100, 1);
  const std::string before = bytes_of(old);
  const std::string text = failure([&] { write_sample(world_, directory_, 200, 1, 100000, 1000); });
  EXPECT_NE(text.find("No space left on device"), std::string::npos) << text;
  EXPECT_EQ(names_in_directory(), std::vector<std::string>{"checkpoint_000000000100.h5"});
  EXPECT_TRUE(bytes_of(old) == before);
  EXPECT_TRUE(is_sample(read_checkpoint(world_, write_sample(world_, directory_, 300, 1)), 300));
}

}  // namespace
}  // namespace sphdrop
