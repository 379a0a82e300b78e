// The history's bytes, its resumption after a restart or a crash, and a full disk (/dev/full) under it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "io/history.hpp"

namespace sphdrop {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class History : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    directory_ = std::filesystem::path(testing::TempDir()) / ("sphdrop_history_" + name + std::to_string(::getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path csv() const { return directory_ / "history.csv"; }

  std::filesystem::path directory_;
  std::vector<HistoryColumn> columns_ = {
      {"time", "s", "simulated time"}, {"step", "1", "number of the step"}, {"drop_width", "m", "D(t)"}};
};

TEST_F(History, HasExactlyTheseBytes) {
  auto history = HistoryWriter::create(directory_, columns_);
  history.append(std::array{0.0, 0.0, 1e-3});
  history.append(std::array{5e-9, 123456789.0, 1.0 / 3.0});
  history.append(std::array{1e-8, 9007199254740992.0, std::nan("")});
  history.close();
  EXPECT_EQ(text_of(csv()),
            "time [s],step [1],drop_width [m]\n"
            "0,0,0.001\n"
            "5e-09,123456789,0.3333333333333333\n"
            "1e-08,9007199254740992,nan\n");
  EXPECT_EQ(text_of(directory_ / "history_columns.json"),
            "{\n"
            "  \"time\": {\n    \"unit\": \"s\",\n    \"description\": \"simulated time\"\n  },\n"
            "  \"step\": {\n    \"unit\": \"1\",\n    \"description\": \"number of the step\"\n  },\n"
            "  \"drop_width\": {\n    \"unit\": \"m\",\n    \"description\": \"D(t)\"\n  }\n"
            "}\n");
}

TEST_F(History, HoldsWholeLinesOnlyWhileItIsWritten) {
  auto history = HistoryWriter::create(directory_, columns_);
  for (int row = 0; row < 1000; ++row) history.append(std::array{row * 1e-9, 1.0 * row, std::sqrt(row)});
  const std::string so_far = text_of(csv());
  EXPECT_EQ(so_far.back(), '\n');
  history.flush();
  const std::string all = text_of(csv());
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1001);
  EXPECT_TRUE(all.starts_with(so_far));
}

TEST_F(History, ResumedAfterARestartIsTheSameAsAnUnbrokenOne) {
  const auto write_rows = [](HistoryWriter& history, int first, int last) {
    for (int row = first; row <= last; ++row) history.append(std::array{row * 0.1, 1.0 * row, row / 7.0});
  };
  auto unbroken = HistoryWriter::create(directory_, columns_);
  write_rows(unbroken, 0, 20);
  unbroken.close();
  const std::string expected = text_of(csv());

  auto first_half = HistoryWriter::create(directory_, columns_);
  write_rows(first_half, 0, 15);  // The checkpoint was at row 10.
  first_half.close();
  auto second_half = HistoryWriter::resume(directory_, columns_, 11 * 0.1);
  write_rows(second_half, 11, 20);
  second_half.close();
  EXPECT_EQ(text_of(csv()), expected);
}

TEST_F(History, ResumptionDropsALineCutOffByACrash) {
  auto history = HistoryWriter::create(directory_, columns_);
  history.append(std::array{0.0, 0.0, 1.0});
  history.append(std::array{1.0, 1.0, 2.0});
  history.close();
  const std::string whole = text_of(csv());
  std::ofstream(csv(), std::ios::app) << "2,2,0.1";
  HistoryWriter::resume(directory_, columns_, 100.0).close();
  EXPECT_EQ(text_of(csv()), whole);
}

TEST_F(History, ResumptionWithoutAHistoryStartsOne) {
  HistoryWriter::resume(directory_, columns_, 1.0).close();
  EXPECT_EQ(text_of(csv()), "time [s],step [1],drop_width [m]\n");
}

TEST_F(History, RefusesToResumeOtherColumns) {
  HistoryWriter::create(directory_, columns_).close();
  const std::string before = text_of(csv());
  columns_[2].unit = "mm";
  EXPECT_THROW(HistoryWriter::resume(directory_, columns_, 1.0), HistoryError);
  EXPECT_EQ(text_of(csv()), before);
}

TEST_F(History, RefusesWrongRowsAndColumns) {
  auto history = HistoryWriter::create(directory_, columns_);
  EXPECT_THROW(history.append(std::array{1.0, 2.0}), HistoryError);
  history.append(std::array{1.0, 1.0, 1.0});
  EXPECT_THROW(history.append(std::array{1.0, 2.0, 2.0}), HistoryError) << "time stands still";
  EXPECT_THROW(history.append(std::array{std::nan(""), 2.0, 2.0}), HistoryError);
  EXPECT_THROW(HistoryWriter::create(directory_, {{"a,b", "1", ""}}), HistoryError);
  EXPECT_THROW(HistoryWriter::create(directory_, {{"a", "", ""}}), HistoryError);
  EXPECT_THROW(HistoryWriter::create(directory_, {{"a", "1", ""}, {"a", "1", ""}}), HistoryError);
  EXPECT_THROW(HistoryWriter::create(directory_ / "missing", columns_), HistoryError);
}

TEST_F(History, ReportsAFullDisk) {
  // Writes to /dev/full fail with ENOSPC.
  std::filesystem::create_symlink("/dev/full", csv());
  try {
    HistoryWriter::create(directory_, columns_);
    FAIL() << "no exception";
  } catch (const HistoryError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sphdrop
