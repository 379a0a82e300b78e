#include "config/key_suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "config/nearest_name.hpp"
#include "config/parameter_table.hpp"
#include "config/utf8.hpp"

namespace sphdrop {
namespace {

std::string place(const Parameter& parameter) {
  return parameter.section().empty() ? "above the first section" : fmt::format("in section [{}]", parameter.section());
}

// A known name in another section: most likely only the section is wrong.
std::string same_name_elsewhere(std::string_view name) {
  std::string text;
  for (const Parameter& parameter : parameter_table()) {
    if (parameter.name() != name) continue;
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", parameter.key, place(parameter));
  }
  return text;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 100;
  std::string result(text.substr(0, longest));
  if (const auto invalid = first_invalid_utf8(result)) result.resize(*invalid);
  std::replace_if(result.begin(), result.end(), is_control, '?');
  return text.size() > result.size() ? result + "..." : result;
}

std::string unknown_key_message(std::string_view section, std::string_view name) {
  const std::string key = section.empty() ? std::string(name) : fmt::format("{}.{}", section, name);
  std::vector<std::string_view> names_here;
  std::vector<std::string_view> keys;
  for (const Parameter& parameter : parameter_table()) {
    if (parameter.section() == section) names_here.push_back(parameter.name());
    keys.push_back(parameter.key);
  }
  std::string suggestion;
  const std::string elsewhere = same_name_elsewhere(name);
  if (!elsewhere.empty()) {
    suggestion = fmt::format("; there is {}", elsewhere);
  } else if (const auto here = nearest_name(name, names_here)) {
    suggestion = fmt::format("; did you mean {}{}{}?", section, section.empty() ? "" : ".", *here);
  } else if (const auto anywhere = nearest_name(key, keys)) {
    suggestion = fmt::format("; did you mean {}?", *anywhere);
  } else {
    for (const Parameter& parameter : parameter_table()) {
      const std::string_view known[] = {parameter.name()};
      if (!nearest_name(name, known)) continue;
      suggestion = fmt::format("; did you mean {}, {}?", parameter.key, place(parameter));
      break;
    }
  }
  if (suggestion.empty()) suggestion = "; sphdrop --list-parameters shows all keys";
  return fmt::format("{} is not a known key{}", printable(key), suggestion);
}

std::string unknown_section_message(std::string_view name) {
  const auto nearest = nearest_name(name, section_names());
  std::string all;
  for (const std::string_view known : section_names()) all += fmt::format("{}{}", all.empty() ? "" : ", ", known);
  return fmt::format("[{}] is not a known section; the sections are {}{}", printable(name), all,
                     nearest ? fmt::format("; did you mean [{}]?", *nearest) : "");
}

}  // namespace sphdrop
