#include "io/file_checksum.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>

#include "io/posix_file.hpp"
#include "io/rows_by_id.hpp"

namespace sphdrop {

Digest digest_of(std::span<const std::byte> bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  Digest digest;
  static_assert(sizeof(canonical.digest) == sizeof(Digest));
  std::memcpy(digest.data(), canonical.digest, digest.size());
  return digest;
}

Digest digest_of(std::string_view text) {
  return digest_of(std::as_bytes(std::span(text)));
}

std::string hexadecimal(const Digest& digest) {
  std::string text;
  for (const std::byte byte : digest) text += fmt::format("{:02x}", std::to_integer<unsigned>(byte));
  return text;
}

std::vector<Digest> own_block_digests(const Communicator& communicator, const std::filesystem::path& path,
                                      std::int64_t begin, std::int64_t end) {
  const std::int64_t block_count = (end - begin + checksum_block_bytes - 1) / checksum_block_bytes;
  const RowBlock own = RowBlock::of_rank(block_count, communicator.rank(), communicator.size());
  const FileDescriptor file(path, O_RDONLY);
  std::vector<Digest> digests;
  digests.reserve(static_cast<std::size_t>(own.size()));
  std::vector<std::byte> buffer(static_cast<std::size_t>(checksum_block_bytes));
  for (std::int64_t block = own.first; block < own.end; ++block) {
    const std::int64_t position = begin + block * checksum_block_bytes;
    const auto bytes =
        std::span(buffer).first(static_cast<std::size_t>(std::min(end - position, checksum_block_bytes)));
    file.read_at(position, bytes);
    digests.push_back(digest_of(bytes));
  }
  return digests;
}

Digest combined_digest(const Communicator& communicator, std::span<const Digest> own_digests) {
  const std::vector<Digest> all = communicator.all_gather(own_digests);
  return digest_of(std::as_bytes(std::span(all)));
}

}  // namespace sphdrop
