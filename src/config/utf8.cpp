#include "config/utf8.hpp"

namespace sphdrop {
namespace {

// RFC 3629, section 4: length of the sequence a first byte announces, and the range its second byte may have.
struct SequenceStart {
  std::size_t length;
  unsigned char second_lower = 0x80;
  unsigned char second_upper = 0xbf;
};

SequenceStart sequence_start(unsigned char byte) {
  if (byte <= 0x7f) return {1};
  if (byte >= 0xc2 && byte <= 0xdf) return {2};
  if (byte == 0xe0) return {3, 0xa0, 0xbf};
  if (byte == 0xed) return {3, 0x80, 0x9f};
  if (byte >= 0xe1 && byte <= 0xef) return {3};
  if (byte == 0xf0) return {4, 0x90, 0xbf};
  if (byte >= 0xf1 && byte <= 0xf3) return {4};
  if (byte == 0xf4) return {4, 0x80, 0x8f};
  return {0};
}

}  // namespace

std::optional<std::size_t> first_invalid_utf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const SequenceStart start = sequence_start(static_cast<unsigned char>(text[i]));
    if (start.length == 0 || i + start.length > text.size()) return i;
    for (std::size_t k = 1; k < start.length; ++k) {
      const auto byte = static_cast<unsigned char>(text[i + k]);
      const unsigned char lower = k == 1 ? start.second_lower : 0x80;
      const unsigned char upper = k == 1 ? start.second_upper : 0xbf;
      if (byte < lower || byte > upper) return i;
    }
    i += start.length;
  }
  return std::nullopt;
}

}  // namespace sphdrop
