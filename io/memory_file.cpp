#include "io/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <vector>

namespace sphdrop {
namespace {

constexpr std::int64_t longest_piece = 1 << 20;

FileDescriptor file_in_memory() {
  const int descriptor = ::memfd_create("sphdrop", MFD_CLOEXEC);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
  return FileDescriptor("a file in memory", FileDescriptor::Owned{descriptor});
}

/// Where the next part that was written (SEEK_DATA) or left out (SEEK_HOLE) begins, from `position` on; the file's size
/// if there is none.
std::int64_t next_part(const FileDescriptor& file, std::int64_t position, int kind) {
  const std::int64_t found = ::lseek(file.get(), position, kind);
  if (found >= 0) return found;
  if (errno != ENXIO) throw std::system_error(errno, std::generic_category(), "lseek in a file in memory");
  return file.size();
}

}  // namespace

MemoryFile::MemoryFile() : file_(file_in_memory()) {}

void MemoryFile::copy_to(FileDescriptor& target) const {
  const std::int64_t size = file_.size();
  std::vector<std::byte> piece;
  for (std::int64_t begin = next_part(file_, 0, SEEK_DATA); begin < size; begin = next_part(file_, begin, SEEK_DATA)) {
    const std::int64_t end = next_part(file_, begin, SEEK_HOLE);
    while (begin < end) {
      piece.resize(static_cast<std::size_t>(std::min(end - begin, longest_piece)));
      file_.read_at(begin, piece);
      target.write_at(begin, {reinterpret_cast<const char*>(piece.data()), piece.size()});
      begin += std::ssize(piece);
    }
  }
  target.truncate(size);
}

}  // namespace sphdrop
