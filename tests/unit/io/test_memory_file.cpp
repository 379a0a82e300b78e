// A file in memory is copied as it is, and what was never written takes no space.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "io/memory_file.hpp"

namespace sphdrop {
namespace {

namespace fs = std::filesystem;

class MemoryFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(path_.parent_path()); }
  void TearDown() override { fs::remove_all(path_.parent_path()); }

  std::string copied(const MemoryFile& memory, const std::string& before = "") const {
    std::ofstream(path_, std::ios::binary) << before;
    FileDescriptor target(path_, O_WRONLY);
    memory.copy_to(target);
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  static void write(const MemoryFile& memory, std::int64_t position, const std::string& text) {
    ASSERT_EQ(pwrite(memory.descriptor(), text.data(), text.size(), position), std::ssize(text));
  }

  const fs::path path_ = fs::path(testing::TempDir()) / ("memory_file_" + std::to_string(getpid())) / "copy";
};

TEST_F(MemoryFiles, AreCopiedWithTheirHolesAndTheirSize) {
  const MemoryFile memory;
  EXPECT_EQ(copied(memory, "what was there"), "");

  std::string expected(7'000'000, '\0');
  const std::string begin = "begin", long_text(2'500'000, 'x'), end = "end";
  write(memory, 0, begin);
  write(memory, 3'000'001, long_text);
  write(memory, 6'900'000, end);
  ASSERT_EQ(ftruncate(memory.descriptor(), std::ssize(expected)), 0);
  expected.replace(0, begin.size(), begin);
  expected.replace(3'000'001, long_text.size(), long_text);
  expected.replace(6'900'000, end.size(), end);
  EXPECT_TRUE(copied(memory) == expected);
}

TEST_F(MemoryFiles, LeaveAloneWhatTheTargetHasInTheirHoles) {
  const MemoryFile memory;
  write(memory, 8192, "text");
  const std::string before(10'000, 'x');
  EXPECT_EQ(copied(memory, before), before.substr(0, 8192) + "text");
}

TEST_F(MemoryFiles, MayMove) {
  MemoryFile first;
  write(first, 0, "first");
  MemoryFile second = std::move(first);
  EXPECT_EQ(copied(second), "first");
  second = MemoryFile();
  EXPECT_EQ(copied(second), "");
}

TEST_F(MemoryFiles, AreCopiedTwiceAndInBetweenWritten) {
  const MemoryFile memory;
  write(memory, 0, "one");
  EXPECT_EQ(copied(memory), "one");
  write(memory, 3, ", two");
  EXPECT_EQ(copied(memory), "one, two");
}

TEST_F(MemoryFiles, TakeNoSpaceForWhatIsNotWritten) {
  const MemoryFile memory;
  write(memory, 1'000'000'000'000, "far away");
  struct stat status = {};
  ASSERT_EQ(fstat(memory.descriptor(), &status), 0);
  EXPECT_EQ(status.st_size, 1'000'000'000'008);
  EXPECT_LT(status.st_blocks * 512, 100'000);
}

TEST_F(MemoryFiles, TellWhenTheyCannotBeCopied) {
  const MemoryFile memory;
  write(memory, 0, "text");
  copied(memory);
  FileDescriptor read_only(path_, O_RDONLY);
  EXPECT_THROW(memory.copy_to(read_only), std::system_error);
}

}  // namespace
}  // namespace sphdrop
