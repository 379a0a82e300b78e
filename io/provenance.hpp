#pragma once
// run.json: by what, where and how results came about.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "decomposition/communicator.hpp"
#include "io/build_info.hpp"
#include "io/collective_error.hpp"
#include "io/json.hpp"

namespace sphdrop {

/// run.json could not be written.
class RunRecordError : public CollectiveError {
 public:
  using CollectiveError::CollectiveError;
};

/// The record of one run, kept by all ranks and written by rank 0. Written at the start it says "running", which is
/// what remains of a run that was killed.
class RunRecord {
 public:
  /// Collective: asks every rank for its host's name. Starts the clock.
  RunRecord(const Communicator& communicator, std::vector<std::string> command_line);

  /// Anything the program adds under "details": phases, numbers of particles, repartitions...
  template <class Value>
  void set(std::string_view key, const Value& value) {
    details_.set(key, value);
  }

  /// `status` in words: "completed", "stopped: ...". Stops the clock.
  void finish(std::string_view status, std::uint64_t state_hash);
  /// As above, without a state that could be hashed.
  void finish(std::string_view status);

  std::string json() const;
  /// Collective: rank 0 writes json() to `directory`/run.json atomically. Throws RunRecordError on all ranks.
  void write(const Communicator& communicator, const std::filesystem::path& directory) const;

 private:
  int ranks_;
  std::vector<std::string> hosts_;  ///< one a rank
  std::vector<std::string> command_line_;
  std::chrono::system_clock::time_point start_;
  std::chrono::steady_clock::time_point clock_start_;
  std::string status_ = "running";
  std::string end_;
  std::string state_hash_;
  double wall_time_ = 0;  ///< s
  JsonObject details_;
};

}  // namespace sphdrop
