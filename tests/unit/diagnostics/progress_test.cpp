#include "diagnostics/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace sphdrop {
namespace {

/// A temporary file whose text can be read back.
class Stream {
 public:
  Stream() : file_(std::tmpfile()) {}
  ~Stream() { std::fclose(file_); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  std::FILE* get() { return file_; }
  std::string text() {
    std::string all(static_cast<std::size_t>(std::ftell(file_)), '\0');
    std::rewind(file_);
    EXPECT_EQ(std::fread(all.data(), 1, all.size(), file_), all.size());
    return all;
  }

 private:
  std::FILE* file_;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

ProgressSample sample(double wall, double time, std::int64_t step) {
  return {time, step, wall, 1.8461e-3, -0.28631e-3, 0.0123};
}

/// What a terminal shows after the text: \r returns to the first column, characters overwrite.
std::string shown(const std::string& text) {
  std::string line;
  std::size_t column = 0;
  for (const char c : text) {
    if (c == '\r') {
      column = 0;
    } else {
      if (column == line.size()) line += ' ';
      line[column++] = c;
    }
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

TEST(Progress, HoursMinutesSeconds) {
  EXPECT_EQ(hours_minutes_seconds(0.0), "0:00:00");
  EXPECT_EQ(hours_minutes_seconds(59.6), "0:01:00");
  EXPECT_EQ(hours_minutes_seconds(3661.2), "1:01:01");
  EXPECT_EQ(hours_minutes_seconds(360000.0), "100:00:00");
  for (const double none : {-1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_EQ(hours_minutes_seconds(none), "-:--:--");
}

TEST(Progress, LogLineTellsEverything) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::log, 8e-3);
  progress.update(sample(100.0, 0.0, 0));
  progress.update(sample(105.0, 0.5e-3, 5000));
  progress.update(sample(110.0, 1e-3, 10000));
  EXPECT_EQ(stream.text(),
            " 12.5 %  t 1.000/8.000 ms  step 10000  1000/s  ETA 0:01:10  D 1.846 mm  delta -0.2863 mm  dE 1.23 %\n");
}

TEST(Progress, QuantitiesTheCaseLacksAreLeftOut) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::log, 8e-3);
  progress.update({0.0, 0, 0.0, {}, {}, {}});
  progress.update({1e-3, 10000, 10.0, {}, {}, {}});
  EXPECT_EQ(stream.text(), " 12.5 %  t 1.000/8.000 ms  step 10000  1000/s  ETA 0:01:10\n");
}

TEST(Progress, LogIntervalsGrow) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::log, 10.0);
  // The wall clock in seconds serves as the step, so the lines tell when they were written.
  for (int second = 0; second <= 6000; ++second) progress.update(sample(500.0 + second, 1e-4 * second, second));
  std::vector<int> written;
  for (const auto& line : split(stream.text(), '\n')) written.push_back(std::stoi(line.substr(line.find("step") + 5)));
  std::vector<int> expected{10, 20, 30, 40, 50, 60};
  for (int second = 120; second <= 3600; second += 60) expected.push_back(second);
  for (int second = 4200; second <= 6000; second += 600) expected.push_back(second);
  EXPECT_EQ(written, expected);
}

TEST(Progress, TerminalRewritesOneLineOnceASecondAndWipesIt) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::terminal, 1.0);
  for (int i = 0; i <= 100; ++i) progress.update(sample(0.1 * i, 0.001 * i, 100 * i));
  const std::string before = stream.text();
  EXPECT_EQ(std::count(before.begin(), before.end(), '\r'), 10);
  EXPECT_EQ(before.find('\n'), std::string::npos);
  EXPECT_EQ(shown(before).substr(0, 9), " 10.0 %  ");
  EXPECT_NE(shown(before).find("step 10000  1000/s"), std::string::npos);
  progress.finish();
  EXPECT_EQ(shown(stream.text()), "");
  progress.finish();
  // A second finish() adds nothing.
  EXPECT_EQ(stream.text().size(), before.size() + 2 + shown(before).size());
}

TEST(Progress, ShorterLineLeavesNothingOfALongerOne) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::terminal, 1.0);
  progress.update(sample(0.0, 0.0, 0));
  progress.update(sample(1.0, 0.1, 1000));
  progress.update({0.2, 2000, 2.0, {}, {}, {}});
  EXPECT_EQ(shown(stream.text()), " 20.0 %  t 200.000/1000.000 ms  step 2000  1000/s  ETA 0:00:08");
}

TEST(Progress, FitsAHundredColumnsWhateverTheNumbers) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::terminal, 1e6);
  progress.update(sample(0.0, 0.0, 0));
  progress.update({1e5, 123456789012345, 1e3, 1e9, -1e9, 1e12});
  progress.update({1e5, 123456789012345, 2e3, NAN, INFINITY, NAN});
  for (const auto& line : split(stream.text(), '\r')) EXPECT_LE(line.size(), 99u);
}

TEST(Progress, StepRateIsTheLastInterval) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::log, 1.0);
  progress.update(sample(0.0, 0.0, 0));
  progress.update(sample(10.0, 0.1, 10000));
  progress.update(sample(20.0, 0.2, 12000));
  const auto lines = split(stream.text(), '\n');
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find(" 1000/s"), std::string::npos);
  EXPECT_NE(lines[1].find(" 200/s"), std::string::npos);
}

TEST(Progress, EstimateFollowsTheRecentRate) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::terminal, 1.0);
  // 0.001 a second at first, then four times slower: after a while only the slow rate counts.
  double time = 0;
  progress.update(sample(0.0, 0.0, 0));
  for (int second = 1; second <= 300; ++second) {
    time += second <= 200 ? 0.001 : 0.00025;
    progress.update(sample(second, time, second));
  }
  ASSERT_NEAR(time, 0.225, 1e-12);
  EXPECT_NE(shown(stream.text()).find("ETA 0:51:40"), std::string::npos) << shown(stream.text());  // 0.775/0.00025 s
}

TEST(Progress, EstimateCountsFromTheRestart) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::log, 1.0);
  progress.update(sample(0.0, 0.5, 500));
  progress.update(sample(10.0, 0.6, 600));
  EXPECT_NE(stream.text().find(" 60.0 %"), std::string::npos);
  EXPECT_NE(stream.text().find(" 10/s  ETA 0:00:40"), std::string::npos);
}

TEST(Progress, QuietWritesNothing) {
  Stream stream;
  Progress progress(stream.get(), Progress::Mode::quiet, 1.0);
  for (int i = 0; i < 100; ++i) progress.update(sample(10.0 * i, 0.01 * i, i));
  progress.finish();
  EXPECT_EQ(stream.text(), "");
}

}  // namespace
}  // namespace sphdrop
