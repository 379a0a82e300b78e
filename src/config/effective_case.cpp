#include "config/effective_case.hpp"

#include <fmt/format.h>

#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"
#include "config/several_drops.hpp"

namespace sphdrop {

namespace {

void append_parameter(std::string& text, const Parameter& parameter, const Case& values) {
  const std::string assignment = fmt::format("{} = {}", parameter.name(), value_text(parameter, values));
  std::string comment;
  if (parameter.unit != "-") comment += fmt::format("{}; ", parameter.unit);
  if (!parameter.symbol.empty()) comment += fmt::format("{}; ", parameter.symbol);
  text += fmt::format("{:<44}  # {}{}\n", assignment, comment, parameter.description);
}

void append_section(std::string& text, std::string_view section, std::string_view header, const Case& values) {
  text += fmt::format("\n{}\n", header);
  for (const Parameter& parameter : parameter_table())
    if (parameter.section() == section) append_parameter(text, parameter, values);
}

}  // namespace

std::string effective_case_text(const Case& values) {
  std::string text = "# Every parameter at the value it had. As a case file, this repeats the run.\n\n";
  for (const Parameter& parameter : parameter_table())
    if (parameter.section().empty()) append_parameter(text, parameter, values);
  for (const std::string_view section : section_names()) {
    if (section == "drop" && !values.more_drops.empty()) {
      for (std::size_t k = 0; k < values.drop_count(); ++k)
        append_section(text, section, "[[drop]]", values.with_drop(k));
    } else if (section == "solid" && !values.more_solids.empty()) {
      for (std::size_t k = 0; k < values.solid_count(); ++k)
        append_section(text, section, "[[solid]]", values.with_solid(k));
    } else {
      append_section(text, section, fmt::format("[{}]", section), values);
    }
  }
  return text;
}

}  // namespace sphdrop
