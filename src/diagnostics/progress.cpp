#include "diagnostics/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sphdrop {

std::string hours_minutes_seconds(double seconds) {
  if (!(seconds >= 0.0 && seconds < 9999.0 * 3600.0)) return "-:--:--";
  const auto whole = std::llround(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

Progress::Progress(std::FILE* stream, Mode mode, double total_time)
    : stream_(stream), mode_(mode), total_time_(total_time), marks_{} {}

double Progress::interval(double since_start) const {
  if (mode_ == Mode::terminal) return 1.0;
  if (since_start < 60.0) return 10.0;
  return since_start < 3600.0 ? 60.0 : 600.0;
}

void Progress::remember(const ProgressSample& sample) {
  if (mark_count_ == marks_.size()) {
    std::move(marks_.begin() + 1, marks_.end(), marks_.begin());
    --mark_count_;
  }
  marks_[mark_count_++] = {sample.wall_seconds, sample.time, sample.step};
}

double Progress::remaining_seconds(const ProgressSample& sample) const {
  // A window, not the whole run: the time step and the machine's load change as the run goes.
  const Mark& oldest = marks_.front();
  const double rate = (sample.time - oldest.time) / (sample.wall_seconds - oldest.wall_seconds);
  return std::max(0.0, total_time_ - sample.time) / rate;
}

std::string Progress::line(const ProgressSample& sample) const {
  const Mark& last = marks_[mark_count_ - 1];
  const double steps_per_second =
      static_cast<double>(sample.step - last.step) / (sample.wall_seconds - last.wall_seconds);
  std::string text = fmt::format("{:5.1f} %  t {:.3f}/{:.3f} ms  step {}  {:.0f}/s  ETA {}",
                                 100.0 * sample.time / total_time_, 1e3 * sample.time, 1e3 * total_time_, sample.step,
                                 steps_per_second, hours_minutes_seconds(remaining_seconds(sample)));
  if (sample.drop_width) fmt::format_to(std::back_inserter(text), "  D {:.3f} mm", 1e3 * *sample.drop_width);
  if (sample.deflection) fmt::format_to(std::back_inserter(text), "  delta {:.4f} mm", 1e3 * *sample.deflection);
  if (sample.energy_error) fmt::format_to(std::back_inserter(text), "  dE {:.2f} %", 100.0 * *sample.energy_error);
  if (text.size() > longest_line) text.resize(longest_line);
  return text;
}

void Progress::update(const ProgressSample& sample) {
  if (mode_ == Mode::quiet) return;
  if (!started_) {
    started_ = true;
    start_wall_ = sample.wall_seconds;
    next_wall_ = start_wall_ + interval(0.0);
    remember(sample);
    return;
  }
  if (sample.wall_seconds < next_wall_) return;
  const std::string text = line(sample);
  if (mode_ == Mode::terminal) {
    // Blanks over what the previous, longer line has left.
    fmt::print(stream_, "\r{:<{}}", text, shown_columns_);
    shown_columns_ = text.size();
  } else {
    fmt::print(stream_, "{}\n", text);
  }
  std::fflush(stream_);
  remember(sample);
  next_wall_ = sample.wall_seconds + interval(sample.wall_seconds - start_wall_);
}

void Progress::finish() {
  if (mode_ != Mode::terminal || shown_columns_ == 0) return;
  fmt::print(stream_, "\r{:{}}\r", "", shown_columns_);
  std::fflush(stream_);
  shown_columns_ = 0;
}

}  // namespace sphdrop
