#include "io/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "io/checkpoint_directory.hpp"
#include "io/collective_error.hpp"
#include "io/posix_file.hpp"

namespace sphdrop {
namespace {

/// The uppermost part of `path` that exists and is not a directory; empty if there is none.
std::filesystem::path file_in_the_way(const std::filesystem::path& path) {
  std::filesystem::path part;
  for (const auto& name : path) {
    part /= name;
    std::error_code error;
    const auto status = std::filesystem::status(part, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) return part;
  }
  return {};
}

std::string advice(const std::error_code& error) {
  if (error == std::errc::permission_denied || error == std::errc::operation_not_permitted) {
    return "you have no permission to write there; choose another output directory or change its permissions";
  }
  if (error == std::errc::read_only_file_system) {
    return "the file system is mounted read-only; choose an output directory elsewhere";
  }
  if (error == std::errc::no_space_on_device) return "the disk is full; make room or choose another output directory";
  return fmt::format("{}; choose another output directory", error.message());
}

[[noreturn]] void refuse(const std::filesystem::path& directory, const std::string& reason) {
  throw OutputDirectoryError(fmt::format("the output directory '{}' cannot be used: {}", directory.string(), reason));
}

bool is_result(std::string_view name) {
  constexpr std::array fixed = {std::string_view("history.csv"), std::string_view("history_columns.json"),
                                std::string_view("run.json"), std::string_view("snapshots.vtkhdf.series")};
  if (name.ends_with(".part")) name.remove_suffix(5);
  if (std::find(fixed.begin(), fixed.end(), name) != fixed.end()) return true;
  if (is_checkpoint_file_name(name)) return true;
  constexpr std::string_view start = "snapshot_";
  constexpr std::string_view end = ".vtkhdf";
  if (!name.starts_with(start) || !name.ends_with(end) || name.size() < start.size() + end.size() + 6) return false;
  const std::string_view number = name.substr(start.size(), name.size() - start.size() - end.size());
  return std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void create_writable_directory(const std::filesystem::path& directory) {
  if (directory.empty()) refuse(directory, "its name is empty; give one, or '.' for the current directory");
  const auto obstacle = file_in_the_way(directory);
  if (!obstacle.empty()) {
    refuse(directory, fmt::format("'{}' is a file; remove it or choose another output directory", obstacle.string()));
  }
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) refuse(directory, advice(error));
  const auto probe = directory / ".sphdrop_write_test";
  try {
    FileDescriptor file(probe, O_WRONLY | O_CREAT | O_TRUNC);
    file.write("can files be written here?\n");
    file.close();
    std::filesystem::remove(probe);
  } catch (const std::system_error& failure) {
    std::filesystem::remove(probe, error);
    refuse(directory, advice(failure.code()));
  }
}

void prepare_output_directory(const Communicator& communicator, const std::filesystem::path& directory) {
  collectively<OutputDirectoryError>(communicator, [&] {
    if (communicator.rank() == 0) create_writable_directory(directory);
  });
  collectively<OutputDirectoryError>(communicator, [&] {
    std::error_code ignored;
    if (!std::filesystem::is_directory(directory, ignored)) {
      refuse(directory, "rank 0 has made it, but other ranks do not see it; choose one on a shared file system");
    }
  });
}

std::vector<std::filesystem::path> results_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> results;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    if (is_result(entry.path().filename().string())) results.push_back(entry.path());
  }
  std::sort(results.begin(), results.end());
  return results;
}

}  // namespace sphdrop
