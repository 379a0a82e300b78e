#pragma once
// One parameter's value: from TOML into a Case.

#include <optional>
#include <string>
#include <string_view>

#include "config/parameter_table.hpp"
#include "config/toml_source.hpp"

namespace sphdrop {

/// Puts the value into the case. Otherwise leaves the case alone and says what is wrong and what is allowed.
std::optional<std::string> store(const Parameter& parameter, const TomlNode& value, Case& values);

/// NaN or the empty string where the default is "auto" (as for `key = "auto"`); NaN for a required one.
void store_default(const Parameter& parameter, Case& values);

/// A decimal number with an optional sign, point and exponent; none if it is anything else or no finite double.
std::optional<double> parse_number(std::string_view text);

}  // namespace sphdrop
