#include "io/posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace sphdrop {
namespace {

[[noreturn]] void throw_system_error(int code, const char* call, const std::filesystem::path& path) {
  throw std::system_error(code, std::generic_category(), fmt::format("{}: {}", path.string(), call));
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

FileDescriptor::FileDescriptor(const std::filesystem::path& path, int flags) : path_(path) {
  do {
    descriptor_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EINTR);
  if (descriptor_ < 0) throw_system_error(errno, "open", path);
}

FileDescriptor::FileDescriptor(std::filesystem::path path, Owned open_file)
    : path_(std::move(path)), descriptor_(open_file.descriptor) {}

FileDescriptor::~FileDescriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void FileDescriptor::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw_system_error(errno, "write", path_);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void FileDescriptor::read_at(std::int64_t position, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t length = ::pread(descriptor_, bytes.data(), bytes.size(), position);
    if (length < 0 && errno == EINTR) continue;
    if (length < 0) throw_system_error(errno, "pread", path_);
    if (length == 0) {
      throw_system_error(EIO, fmt::format("the file ends {} bytes too early", bytes.size()).c_str(), path_);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(length));
    position += length;
  }
}

void FileDescriptor::write_at(std::int64_t position, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::pwrite(descriptor_, text.data(), text.size(), position);
    if (written < 0) {
      if (errno == EINTR) continue;
      throw_system_error(errno, "pwrite", path_);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
    position += written;
  }
}

void FileDescriptor::rewrite(std::int64_t position, std::size_t bytes) {
  std::string text(bytes, '\0');
  const ssize_t length = ::pread(descriptor_, text.data(), bytes, position);
  if (length < 0) throw_system_error(errno, "pread", path_);
  if (::pwrite(descriptor_, text.data(), static_cast<std::size_t>(length), position) != length) {
    throw_system_error(errno, "pwrite", path_);
  }
}

std::int64_t FileDescriptor::size() const {
  struct stat status = {};
  if (::fstat(descriptor_, &status) != 0) throw_system_error(errno, "fstat", path_);
  return status.st_size;
}

void FileDescriptor::truncate(std::int64_t size) {
  if (::ftruncate(descriptor_, size) != 0) throw_system_error(errno, "ftruncate", path_);
}

void FileDescriptor::synchronise() {
  if (::fsync(descriptor_) != 0) throw_system_error(errno, "fsync", path_);
}

void FileDescriptor::close() {
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) throw_system_error(errno, "close", path_);
}

void reserve_space(const std::filesystem::path& path, std::int64_t bytes) {
  if (bytes <= 0) return;
  const FileDescriptor file(path, O_WRONLY);
  int status = 0;
  do {
    status = ::fallocate(file.get(), FALLOC_FL_KEEP_SIZE, 0, bytes);
  } while (status != 0 && errno == EINTR);
  if (status == 0) return;
  if (errno != EOPNOTSUPP && errno != ENOSYS) {
    throw_system_error(errno, fmt::format("reserving {} bytes of disk space (fallocate)", bytes).c_str(), path);
  }
  struct statvfs volume = {};
  if (::fstatvfs(file.get(), &volume) != 0) throw_system_error(errno, "fstatvfs", path);
  if (volume.f_bavail * volume.f_frsize < static_cast<std::uint64_t>(bytes)) {
    throw_system_error(ENOSPC, fmt::format("{} bytes are needed (statvfs)", bytes).c_str(), path);
  }
}

void release_unused_space(const std::filesystem::path& path) {
  FileDescriptor file(path, O_WRONLY);
  file.truncate(file.size());
  file.close();
}

void synchronise_file(const std::filesystem::path& path) {
  FileDescriptor(path, O_RDONLY).synchronise();
}

void synchronise_folder(const std::filesystem::path& folder) {
  FileDescriptor(folder, O_RDONLY | O_DIRECTORY).synchronise();
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) throw_system_error(errno, "renaming the finished file to its name", to);
  synchronise_folder(folder_of(to));
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path part = path;
  part += ".part";
  try {
    FileDescriptor file(part, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(text);
    file.synchronise();
    file.close();
    rename_durably(part, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace sphdrop
