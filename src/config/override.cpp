#include "config/override.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "config/case_error.hpp"
#include "config/key_suggestion.hpp"
#include "config/parameter_table.hpp"
#include "config/quantity.hpp"
#include "config/several_drops.hpp"
#include "config/utf8.hpp"

namespace sphdrop {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

bool is_quoted(const std::string& text) {
  return text.front() == '"' || text.front() == '\'';
}

// "auto" for a number; and a word where a number belongs is told so better than as a mistake in TOML.
bool is_letters(const std::string& text) {
  return text != "inf" && text != "nan" && text != "true" && text != "false" &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || c == '_'; });
}

// "1.5 mm" or "300MPa"; 0x1F, 1_000 and dates are TOML's.
bool has_unit(const std::string& text) {
  return looks_like_quantity(text) && text.find_first_of("_xob:,\"'") == std::string::npos;
}

TomlNode text_node(const std::string& text) {
  TomlNode node;
  node.kind = TomlNode::Kind::string;
  node.text = text;
  return node;
}

std::string unknown_key(const std::string& key) {
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos) return unknown_key_message("", key);
  return unknown_key_message(key.substr(0, dot), key.substr(dot + 1));
}

// "drop[2].diameter" is drop.diameter of the second drop; what is not quite so remains, as an unknown key.
void take_index(Override& parsed) {
  const std::size_t begin = parsed.key.find('['), end = parsed.key.find("].");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return;
  const std::string section = parsed.key.substr(0, begin);
  if (!may_repeat(section)) return;
  const std::string digits = parsed.key.substr(begin + 1, end - begin - 1);
  const bool is_number =
      !digits.empty() && digits.size() < 7 && digits.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number || std::stoi(digits) < 1) return;
  parsed.index = static_cast<std::size_t>(std::stoi(digits)) - 1;
  parsed.key = section + parsed.key.substr(end + 1);
}

}  // namespace

Override parse_override(const std::string& text) {
  Override parsed;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || trimmed(text.substr(0, equals)).empty()) {
    parsed.mistake = "must read key=value, for example --set time.end=1e-3";
    return parsed;
  }
  parsed.key = trimmed(text.substr(0, equals));
  take_index(parsed);
  const std::string value = trimmed(text.substr(equals + 1));
  const Parameter* parameter = find_parameter(parsed.key);
  if (parameter == nullptr) {
    parsed.mistake = unknown_key(parsed.key);
  } else if (value.empty()) {
    parsed.mistake = fmt::format("{} has no value after the =", parsed.key);
  } else if (std::any_of(value.begin(), value.end(), is_control) || first_invalid_utf8(value)) {
    parsed.mistake = fmt::format(
        "the value of {} holds a line break, another control character or bytes that are not UTF-8", parsed.key);
  } else {
    const bool takes_words = std::holds_alternative<WordParameter>(parameter->value) ||
                             std::holds_alternative<TextParameter>(parameter->value);
    // A value with a unit needs no quotes here, which a shell would eat.
    if ((takes_words && !is_quoted(value)) || is_letters(value) || (!takes_words && has_unit(value))) {
      parsed.value = text_node(value);
      return parsed;
    }
    try {
      parsed.value = parse_toml("value = " + value, "--set").members.front();
    } catch (const CaseError&) {
      parsed.mistake =
          fmt::format("{} is not a value in TOML syntax: write numbers as 0.5, -1, 1e-3, vectors as [0, -1]", value);
    }
  }
  return parsed;
}

}  // namespace sphdrop
