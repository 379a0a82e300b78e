#pragma once
// What text a case may hold.

#include <cstddef>
#include <optional>
#include <string_view>

namespace sphdrop {

/// Offset of the first byte that is not part of well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates); none if
/// all is.
std::optional<std::size_t> first_invalid_utf8(std::string_view text);

/// Whether a byte is an ASCII control character (tab and line ends included).
constexpr bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

}  // namespace sphdrop
