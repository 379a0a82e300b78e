// One run at a time into a folder, whatever the number of ranks.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "io/output_directory.hpp"
#include "io/run_lock.hpp"

namespace sphdrop {
namespace {

namespace fs = std::filesystem;

std::string refusal(const Communicator& communicator, const fs::path& directory) {
  try {
    const RunLock lock(communicator, directory);
    return "had";
  } catch (const OutputDirectoryError& error) {
    return error.what();
  }
}

class RunLockTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::path(testing::TempDir()) / ("sphdrop_lock_" + std::to_string(getpid()))).string();
    communicator_.broadcast(name, 0);
    directory_ = name;
    if (communicator_.rank() == 0) fs::create_directories(directory_);
    communicator_.barrier();
  }
  void TearDown() override {
    communicator_.barrier();
    if (communicator_.rank() == 0) fs::remove_all(directory_);
  }
  Communicator communicator_{MPI_COMM_WORLD};
  fs::path directory_;
};

TEST_F(RunLockTest, IsHadByOneAndSaysByWhom) {
  std::optional<RunLock> first;
  first.emplace(communicator_, directory_);
  const std::string text = refusal(communicator_, directory_);
  EXPECT_NE(text.find("another run is writing into " + directory_.string()), std::string::npos) << text;
  EXPECT_NE(text.find("(process "), std::string::npos) << text;
  first.reset();
  EXPECT_EQ(refusal(communicator_, directory_), "had");
}

TEST_F(RunLockTest, AFileThatARunLeftBehindLocksNobodyOut) {
  if (communicator_.rank() == 0) std::ofstream(directory_ / "run.lock") << "process 1 on a host of long ago\n";
  communicator_.barrier();
  EXPECT_EQ(refusal(communicator_, directory_), "had");
}

TEST_F(RunLockTest, AFolderThatIsNotThereIsToldOnAllRanks) {
  EXPECT_NE(refusal(communicator_, directory_ / "missing").find("run.lock"), std::string::npos);
}

}  // namespace
}  // namespace sphdrop
