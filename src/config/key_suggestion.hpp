#pragma once
// What to say about a key or section that no parameter has.

#include <string>
#include <string_view>

namespace sphdrop {

/// section: "" for a key outside all sections.
std::string unknown_key_message(std::string_view section, std::string_view name);

std::string unknown_section_message(std::string_view name);

/// Shortened, and without control characters, for use in a message.
std::string printable(std::string_view text);

}  // namespace sphdrop
