#include "run/results_folder.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <vector>

#include "config/effective_case.hpp"
#include "io/checkpoint.hpp"
#include "io/output_directory.hpp"

namespace sphdrop {

// The effective case is written as case.cfg, which may be the very file the user wrote: `--output .` beside it.
void refuse_to_overwrite_case(const Communicator& communicator, const std::filesystem::path& directory,
                              const std::string& case_file, const std::string& case_text, const Case& input) {
  std::string error;
  if (communicator.rank() == 0) {
    std::error_code not_there;
    const bool is_same = std::filesystem::equivalent(directory / "case.cfg", case_file, not_there);
    if (is_same && case_text != effective_case_text(input))
      error = fmt::format("the results in {} would replace the case file {} itself; choose another --output",
                          directory.string(), case_file);
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

// Checkpoints of a run that did not come to its end are not thrown away because someone forgot to write --restart.
void refuse_to_lose_checkpoints(const Communicator& communicator, const std::filesystem::path& directory) {
  std::string error;
  if (communicator.rank() == 0) {
    std::ifstream file(directory / "run.json");
    const std::string record{std::istreambuf_iterator<char>(file), {}};
    const bool came_to_its_end = record.find("\"status\": \"completed\"") != std::string::npos;
    const std::vector<std::filesystem::path> checkpoints = find_checkpoints(directory);
    if (!checkpoints.empty() && !came_to_its_end)
      error = fmt::format(
          "{} holds checkpoints of a run that is not finished, the newest {}: go on with --restart latest, "
          "start anew with --fresh, or choose another --output",
          directory.string(), checkpoints.front().filename().string());
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

// A run starts with an empty folder: snapshots of an earlier, longer run would mix with its own.
void remove_earlier_results(const Communicator& communicator, const std::filesystem::path& directory) {
  std::string error;
  if (communicator.rank() == 0) {
    try {
      const std::vector<std::filesystem::path> files = results_in(directory);
      for (const std::filesystem::path& file : files) std::filesystem::remove(file);
      if (!files.empty())
        fmt::print(stderr, "note: replacing the {} result files of an earlier run in {}\n", files.size(),
                   directory.string());
    } catch (const std::exception& e) {
      error = e.what();
    }
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

void write_effective_case(const Communicator& communicator, const std::filesystem::path& directory, const Case& input) {
  std::string error;
  if (communicator.rank() == 0) {
    std::ofstream file(directory / "case.cfg");
    file << effective_case_text(input) << std::flush;
    if (!file) error = fmt::format("cannot write {}", (directory / "case.cfg").string());
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

}  // namespace sphdrop
