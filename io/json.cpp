#include "io/json.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sphdrop {
namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

bool is_continuation(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
}

/// The length of the well-formed UTF-8 sequence at the start of `text` (Unicode standard, table 3-7); 0 if there is
/// none.
std::size_t utf8_sequence_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  if (!is_continuation(text, 1)) return 0;
  const auto second = static_cast<unsigned char>(text[1]);
  if (lead < 0xE0) return 2;
  if (!is_continuation(text, 2)) return 0;
  if (lead < 0xF0) {
    const bool overlong = lead == 0xE0 && second < 0xA0;
    const bool surrogate = lead == 0xED && second >= 0xA0;
    return overlong || surrogate ? 0 : 3;
  }
  const bool overlong = lead == 0xF0 && second < 0x90;
  const bool beyond_unicode = lead == 0xF4 && second >= 0x90;
  return !is_continuation(text, 3) || overlong || beyond_unicode ? 0 : 4;
}

/// Indents every line of `text` but the first by two spaces. Strings are escaped, so that newlines are layout only.
std::string indented(std::string_view text) {
  std::string result;
  for (const char character : text) {
    result += character;
    if (character == '\n') result += "  ";
  }
  return result;
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string result = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_sequence_length(text);
    const char character = text[0];
    if (length == 0) {
      result += replacement_character;
    } else if (length > 1) {
      result += text.substr(0, length);
    } else if (character == '"' || character == '\\') {
      result += '\\';
      result += character;
    } else if (character == '\n') {
      result += "\\n";
    } else if (character == '\t') {
      result += "\\t";
    } else if (static_cast<unsigned char>(character) < 0x20 || character == 0x7F) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(character));
    } else {
      result += character;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result + '"';
}

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string json_array(std::span<const std::string> items) {
  std::string result = "[";
  for (const std::string& item : items) {
    if (result.size() > 1) result += ", ";
    result += json_string(item);
  }
  return result + ']';
}

void JsonObject::set_encoded(std::string_view name, std::string value) {
  for (auto& [existing, old_value] : members_) {
    if (existing == name) {
      old_value = std::move(value);
      return;
    }
  }
  members_.emplace_back(name, std::move(value));
}

std::string JsonObject::text() const {
  if (members_.empty()) return "{}";
  std::string result = "{";
  for (const auto& [name, value] : members_) {
    if (result.size() > 1) result += ',';
    result += "\n  " + json_string(name) + ": " + indented(value);
  }
  return result + "\n}";
}

}  // namespace sphdrop
