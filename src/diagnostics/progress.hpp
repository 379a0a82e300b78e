#pragma once
// How far the run has come, for whoever watches it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace sphdrop {

/// What a progress line tells. wall_seconds is any clock that runs forward; the rest are SI values; a quantity the case
/// does not have stays empty.
struct ProgressSample {
  double time = 0;  ///< simulated, s
  std::int64_t step = 0;
  double wall_seconds = 0;
  std::optional<double> drop_width;    ///< D, m
  std::optional<double> deflection;    ///< delta, m, negative downwards
  std::optional<double> energy_error;  ///< unaccounted energy over the initial kinetic energy
};

/// Seconds as h:mm:ss, rounded; "-:--:--" for what is negative, not finite or above 9999 hours.
std::string hours_minutes_seconds(double seconds);

/// Decides when to tell and writes the line. On a terminal one line is rewritten once a second and wiped at the end; in
/// a log a line is added every 10 s in the first minute, every minute in the first hour, every 10 minutes after.
class Progress {
 public:
  enum class Mode { quiet, log, terminal };
  /// No line is longer, so that none wraps on a terminal of 100 columns.
  static constexpr std::size_t longest_line = 99;

  /// The stream stays the caller's and must outlive this object. total_time: the simulated time at which the run ends,
  /// s.
  Progress(std::FILE* stream, Mode mode, double total_time);

  /// Cheap between two lines. The first call only sets the origin: the time may be that of a restart.
  void update(const ProgressSample& sample);

  /// Wipes the terminal's line; nothing is written in the other modes. Call before anything else is printed.
  void finish();

 private:
  struct Mark {
    double wall_seconds = 0, time = 0;
    std::int64_t step = 0;
  };

  double interval(double since_start) const;
  std::string line(const ProgressSample& sample) const;
  double remaining_seconds(const ProgressSample& sample) const;
  void remember(const ProgressSample& sample);

  std::FILE* stream_;
  Mode mode_;
  double total_time_;
  bool started_ = false;
  double start_wall_ = 0;
  double next_wall_ = 0;
  std::size_t shown_columns_ = 0;  ///< of the line now on the terminal
  std::array<Mark, 16> marks_;     ///< the latest lines' marks, oldest first: the window of the estimate
  std::size_t mark_count_ = 0;
};

}  // namespace sphdrop
