#pragma once
// "Did you mean ...?"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sphdrop {

/// Fewest insertions, deletions, substitutions and swaps of neighbouring characters that turn one word into the other
/// (optimal string alignment distance). Upper and lower case ASCII letters count as equal.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name closest to the given word, the first of equals; none if even that differs in more than a third of its
/// characters (or in more than two, for short words).
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string_view> names);

}  // namespace sphdrop
