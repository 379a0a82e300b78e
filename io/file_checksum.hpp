#pragma once
// The checksum of a file's bytes, taken by all ranks together: XXH3 (128 bits) of the XXH3 of each block, so that it
// does not depend on the number of ranks. It finds damage by chance, not forgery.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Big-endian, as XXH128_canonicalFromHash makes it.
using Digest = std::array<std::byte, 16>;

constexpr std::int64_t checksum_block_bytes = 1 << 20;

Digest digest_of(std::span<const std::byte> bytes);
Digest digest_of(std::string_view text);
/// 32 hexadecimal digits.
std::string hexadecimal(const Digest& digest);

/// Those of this rank's blocks when the bytes from `begin` to `end` are dealt out to the ranks in contiguous shares.
/// Throws std::system_error; not collective.
std::vector<Digest> own_block_digests(const Communicator& communicator, const std::filesystem::path& path,
                                      std::int64_t begin, std::int64_t end);

/// Collective. The digest of all ranks' block digests, in their order.
Digest combined_digest(const Communicator& communicator, std::span<const Digest> own_digests);

}  // namespace sphdrop
