#pragma once
// What the C++ library lacks for files that must survive a full disk or a crash. Errors are std::system_error with the
// path and the failed call in the text.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace sphdrop {

/// A file descriptor, closed on destruction.
class FileDescriptor {
 public:
  /// open(2) with these flags, mode 0666.
  FileDescriptor(const std::filesystem::path& path, int flags);
  /// Takes over one that is open; the path is for messages.
  struct Owned {
    int descriptor;
  };
  FileDescriptor(std::filesystem::path path, Owned open_file);
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int get() const { return descriptor_; }
  /// Writes everything, however many write(2) calls it takes.
  void write(std::string_view text);
  /// Reads exactly bytes.size() bytes from `position` on; a file that ends earlier is an error (EIO).
  void read_at(std::int64_t position, std::span<std::byte> bytes) const;
  void write_at(std::int64_t position, std::string_view text);
  /// Reads up to `bytes` from `position` on and writes them back.
  void rewrite(std::int64_t position, std::size_t bytes);
  /// Of the file, in bytes.
  std::int64_t size() const;
  void truncate(std::int64_t size);
  void synchronise();
  /// Some file systems report a failed write only here.
  void close();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Reserves disk space for the first `bytes` of an existing file without changing its size; throws (ENOSPC, EDQUOT)
/// when they are not to be had. On file systems that cannot reserve, the free space is compared instead.
void reserve_space(const std::filesystem::path& path, std::int64_t bytes);

/// Gives back what reserve_space() took beyond the file's end.
void release_unused_space(const std::filesystem::path& path);

/// fsync of a file, or of a folder so that a rename in it is on disk.
void synchronise_file(const std::filesystem::path& path);
void synchronise_folder(const std::filesystem::path& folder);

/// rename(2), then fsync of the folder.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes `path`.part, flushes it to the disk and renames it: readers see the old text or the new one, never half of
/// it. On failure the old file is untouched and the half one removed.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace sphdrop
