#include "io/checkpoint_directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <system_error>
#include <vector>

#include "io/checkpoint.hpp"

namespace sphdrop {
namespace {

constexpr std::string_view part_ending = ".part";

/// The step in a checkpoint's name; nothing in other names.
std::optional<std::int64_t> step_of(std::string_view name) {
  constexpr std::string_view start = "checkpoint_";
  constexpr std::string_view end = ".h5";
  if (!name.starts_with(start) || !name.ends_with(end) || name.size() < start.size() + end.size()) return {};
  const std::string_view digits = name.substr(start.size(), name.size() - start.size() - end.size());
  std::int64_t step = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), step);
  // Only what checkpoint_file_name() makes: no sign, no blank, no needless or missing zeros.
  return name == checkpoint_file_name(step) && step >= 0 ? std::optional(step) : std::nullopt;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  std::filesystem::directory_iterator entry(directory, error);
  while (!error && entry != std::filesystem::directory_iterator()) {
    files.push_back(entry->path());
    entry.increment(error);
  }
  return files;
}

using CheckpointsByStep = std::map<std::int64_t, std::filesystem::path, std::greater<>>;

CheckpointsByStep checkpoints_in(const std::filesystem::path& directory) {
  CheckpointsByStep found;
  for (const auto& path : files_in(directory)) {
    if (const auto step = step_of(path.filename().string())) found.emplace(*step, path);
  }
  return found;
}

}  // namespace

std::string checkpoint_file_name(std::int64_t step) {
  return fmt::format("checkpoint_{:012}.h5", step);
}

bool is_checkpoint_file_name(std::string_view name) {
  return step_of(name).has_value();
}

std::vector<std::filesystem::path> find_checkpoints(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> paths;
  for (auto& [step, path] : checkpoints_in(directory)) paths.push_back(path);
  return paths;
}

void remove_superseded_checkpoints(const std::filesystem::path& directory, std::int64_t step, int keep) {
  std::error_code ignored;
  int kept = 0;
  for (const auto& [found_step, path] : checkpoints_in(directory)) {
    if (found_step <= step && kept < keep) {
      ++kept;
    } else {
      std::filesystem::remove(path, ignored);
    }
  }
  for (const auto& path : files_in(directory)) {
    std::string name = path.filename().string();
    if (!name.ends_with(part_ending)) continue;
    name.resize(name.size() - part_ending.size());
    if (step_of(name)) std::filesystem::remove(path, ignored);
  }
}

}  // namespace sphdrop
