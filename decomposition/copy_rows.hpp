#pragma once
// Rows of a column, one behind the other.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace sphdrop {

/// Columns hold doubles or integers of 8 bytes: memcpy moves their words without reading one type as the other.
inline constexpr std::size_t word_bytes = 8;

inline void copy_rows(void* to, const void* from, std::span<const std::int32_t> rows) {
  auto* target = static_cast<std::byte*>(to);
  const auto* source = static_cast<const std::byte*>(from);
  for (const std::int32_t row : rows) {
    std::memcpy(target, source + static_cast<std::size_t>(row) * word_bytes, word_bytes);
    target += word_bytes;
  }
}

}  // namespace sphdrop
