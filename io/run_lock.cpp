#include "io/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "io/output_directory.hpp"

namespace sphdrop {

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

std::string text_of(const FileDescriptor& file) {
  std::array<char, 512> text{};
  const ssize_t count = pread(file.get(), text.data(), text.size() - 1, 0);
  const std::string whole(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  return whole.substr(0, whole.find('\n'));
}

// Empty if the lock was had.
std::string take(const std::filesystem::path& path, std::optional<FileDescriptor>& held) {
  FileDescriptor file(path, O_RDWR | O_CREAT | O_CLOEXEC);
  if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      throw std::system_error(errno, std::generic_category(), fmt::format("cannot lock {}", path.string()));
    const std::string holder = text_of(file);
    return fmt::format("another run is writing into {}{}; wait for it, stop it, or choose another --output",
                       path.parent_path().string(), holder.empty() ? "" : " (" + holder + ")");
  }
  file.truncate(0);
  file.write_at(0, fmt::format("process {} on {}\n", getpid(), host_name()));
  held.emplace(std::move(file));
  return {};
}

}  // namespace

RunLock::RunLock(const Communicator& communicator, const std::filesystem::path& directory) {
  std::string error;
  if (communicator.rank() == 0) {
    try {
      error = take(directory / "run.lock", file_);
    } catch (const std::system_error& e) {
      error = e.what();
    }
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

}  // namespace sphdrop
