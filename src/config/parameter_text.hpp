#pragma once
// One parameter in words: its value as TOML, and what may be said about it. Needs no locale.

#include <span>
#include <string>
#include <string_view>

#include "config/parameter_table.hpp"

namespace sphdrop {

/// As TOML, so that reading it back gives the same bits.
std::string value_text(const Parameter& parameter, const Case& values);

/// "number", "integer", "[x, y]", "word", "text", "[[x, y], ...]" or "[[[x, y], ...], ...]".
std::string type_text(const Parameter& parameter);

/// "required", "auto (what that means)" or the value as TOML.
std::string default_text(const Parameter& parameter);

/// The range in words and symbols ("> 0 and <= 1"), or the words to choose from.
std::string allowed_text(const Parameter& parameter);

bool is_required(const Parameter& parameter);

/// Shortest decimal that reads back as the same double.
std::string number_text(double value);

/// ">= 0 and < 1"
std::string range_text(const Range& range);

/// "none, round or square"
std::string words_text(std::span<const std::string_view> words);

/// As a TOML basic string: in quotes, with escapes.
std::string quoted(std::string_view text);

}  // namespace sphdrop
