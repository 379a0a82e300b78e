#include "io/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
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

}  // namespace

MemoryFile::MemoryFile() : file_(file_in_memory()) {}

void MemoryFile::copy_to(FileDescriptor& target) const {
  std::vector<std::byte> piece;
  std::int64_t begin = 0;
  // lseek fails behind the last part that was written.
  while ((begin = ::lseek(file_.get(), begin, SEEK_DATA)) >= 0) {
    const std::int64_t end = ::lseek(file_.get(), begin, SEEK_HOLE);
    while (begin < end) {
      piece.resize(static_cast<std::size_t>(std::min(end - begin, longest_piece)));
      file_.read_at(begin, piece);
      target.write_at(begin, {reinterpret_cast<const char*>(piece.data()), piece.size()});
      begin += std::ssize(piece);
    }
  }
  target.truncate(file_.size());
}

}  // namespace sphdrop
