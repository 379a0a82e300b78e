// Files, output directories, errors of HDF5 and the blocks of a snapshot, all on one process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "io/hdf5_file.hpp"
#include "io/output_directory.hpp"
#include "io/posix_file.hpp"
#include "io/rows_by_id.hpp"
#include "io/snapshot_series.hpp"

namespace sphdrop {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class Files : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    directory_ = fs::path(testing::TempDir()) / ("sphdrop_files_" + name + std::to_string(::getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override {
    ::umount2(directory_.c_str(), MNT_DETACH);
    fs::remove_all(directory_);
  }
  /// Mounts a small file system over the directory; false without the right to.
  bool mount_small(const char* size) { return ::mount("tmpfs", directory_.c_str(), "tmpfs", 0, size) == 0; }
  bool make_read_only() { return ::mount("tmpfs", directory_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0; }
  std::string refusal(const fs::path& directory) {
    try {
      create_writable_directory(directory);
    } catch (const OutputDirectoryError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path directory_;
};

TEST_F(Files, AtomicWriteReplacesTheWholeText) {
  const auto path = directory_ / "index";
  write_file_atomically(path, "a long first text\n");
  write_file_atomically(path, "short\n");
  EXPECT_EQ(text_of(path), "short\n");
  EXPECT_FALSE(fs::exists(directory_ / "index.part"));
}

TEST_F(Files, AtomicWriteOnAFullDiskKeepsTheOldFile) {
  if (!mount_small("size=64k")) GTEST_SKIP() << "no right to mount a small file system";
  const auto path = directory_ / "index";
  write_file_atomically(path, "old");
  EXPECT_THROW(write_file_atomically(path, std::string(100000, 'x')), std::system_error);
  EXPECT_EQ(text_of(path), "old");
  EXPECT_FALSE(fs::exists(directory_ / "index.part"));
}

TEST_F(Files, PositionedReadsAndWritesAreWholeOrErrors) {
  const auto path = directory_ / "data";
  std::ofstream(path) << "0123456789";
  FileDescriptor file(path, O_RDWR);
  EXPECT_EQ(file.size(), 10);
  file.write_at(8, "abc");
  EXPECT_EQ(text_of(path), "01234567abc");
  std::array<std::byte, 4> bytes = {};
  file.read_at(7, bytes);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), 4), "7abc");
  EXPECT_THROW(file.read_at(8, bytes), std::system_error) << "the file ends too early";
  file.rewrite(2, 100);
  EXPECT_EQ(text_of(path), "01234567abc");
  EXPECT_THROW(FileDescriptor(path, O_RDONLY).write_at(0, "x"), std::system_error);
}

TEST_F(Files, ReservationShowsAFullDiskBeforeAnythingIsWritten) {
  if (!mount_small("size=64k")) GTEST_SKIP() << "no right to mount a small file system";
  const auto path = directory_ / "data";
  std::ofstream(path) << "abc";
  reserve_space(path, 40000);
  EXPECT_EQ(fs::file_size(path), 3U) << "the size must not change";
  const auto free_when_reserved = fs::space(directory_).free;
  release_unused_space(path);
  EXPECT_EQ(text_of(path), "abc");
  EXPECT_GE(fs::space(directory_).free, free_when_reserved + 32768);
  try {
    reserve_space(path, 100000);
    FAIL() << "no exception";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOSPC);
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  }
}

TEST_F(Files, OutputDirectoryIsMadeWithItsParentsAndLeftEmpty) {
  const auto made = directory_ / "a" / "b" / "c";
  create_writable_directory(made);
  EXPECT_TRUE(fs::is_directory(made));
  EXPECT_TRUE(fs::is_empty(made));
  EXPECT_EQ(refusal(made), "accepted") << "one that exists will do";
  EXPECT_EQ(refusal(made.string() + "/"), "accepted");
}

TEST_F(Files, AFileInTheWayIsNamed) {
  std::ofstream(directory_ / "file") << "x";
  const std::string obstacle = "'" + (directory_ / "file").string() + "' is a file";
  EXPECT_NE(refusal(directory_ / "file").find(obstacle), std::string::npos);
  EXPECT_NE(refusal(directory_ / "file" / "deeper").find(obstacle), std::string::npos);
  EXPECT_NE(refusal("").find("name is empty"), std::string::npos);
}

TEST_F(Files, MissingPermissionIsNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(directory_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(refusal(directory_).find("no permission"), std::string::npos);
  EXPECT_NE(refusal(directory_ / "new").find("no permission"), std::string::npos);
  fs::permissions(directory_, fs::perms::owner_all);
}

TEST_F(Files, AReadOnlyFileSystemIsNamed) {
  if (!mount_small("size=64k") || !make_read_only()) GTEST_SKIP() << "no right to mount a read-only file system";
  EXPECT_NE(refusal(directory_).find("read-only"), std::string::npos) << refusal(directory_);
  EXPECT_NE(refusal(directory_ / "new").find("read-only"), std::string::npos);
}

TEST_F(Files, OnlyFilesOfARunCountAsResults) {
  for (const char* name :
       {"snapshot_000001.vtkhdf", "snapshot_000000.vtkhdf", "snapshot_000002.vtkhdf.part", "history.csv", "run.json",
        "snapshots.vtkhdf.series", "checkpoint_000000000100.h5", "checkpoint_000000000200.h5.part", "checkpoint_100.h5",
        "notes.txt", "snapshot_1.vtkhdf", "snapshot_00000x.vtkhdf", "my_history.csv"}) {
    std::ofstream(directory_ / name) << "x";
  }
  std::vector<std::string> names;
  for (const auto& path : results_in(directory_)) names.push_back(path.filename());
  EXPECT_EQ(names,
            (std::vector<std::string>{"checkpoint_000000000100.h5", "checkpoint_000000000200.h5.part", "history.csv",
                                      "run.json", "snapshot_000000.vtkhdf", "snapshot_000001.vtkhdf",
                                      "snapshot_000002.vtkhdf.part", "snapshots.vtkhdf.series"}));
  EXPECT_TRUE(results_in(directory_ / "missing").empty());
}

TEST_F(Files, Hdf5ErrorsNamePathCallAndReasonAndPrintNothing) {
  testing::internal::CaptureStderr();
  std::string text;
  try {
    Hdf5File::open_to_read((directory_ / "missing.h5").string());
  } catch (const Hdf5Error& error) {
    text = error.what();
  }
  std::ofstream(directory_ / "no.h5") << "this is not HDF5";
  EXPECT_THROW(Hdf5File::open_to_read((directory_ / "no.h5").string()), Hdf5Error);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(text.find("missing.h5"), std::string::npos) << text;
  EXPECT_NE(text.find("H5Fopen"), std::string::npos) << text;
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
}

TEST(RowBlock, CoversEveryRowOnceInNearlyEqualBlocks) {
  for (const int ranks : {1, 2, 3, 7, 64}) {
    for (const std::int64_t total : {0, 1, 2, 6, 7, 100, 1009}) {
      std::int64_t next = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        const RowBlock block = RowBlock::of_rank(total, rank, ranks);
        EXPECT_EQ(block.first, next);
        EXPECT_GE(block.size(), total / ranks);
        EXPECT_LE(block.size(), total / ranks + 1);
        next = block.end;
      }
      EXPECT_EQ(next, total);
    }
  }
}

TEST(SnapshotFileName, HasSixDigitsOrMore) {
  EXPECT_EQ(snapshot_file_name(42), "snapshot_000042.vtkhdf");
  EXPECT_EQ(snapshot_file_name(1234567), "snapshot_1234567.vtkhdf");
}

}  // namespace
}  // namespace sphdrop
