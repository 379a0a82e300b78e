#include "config/effective_case.hpp"

#include <fmt/format.h>

#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"

namespace sphdrop {

std::string effective_case_text(const Case& values) {
  std::string text = "# Every parameter at the value it had. As a case file, this repeats the run.\n\n";
  std::string_view section;
  for (const Parameter& parameter : parameter_table()) {
    if (parameter.section() != section) {
      section = parameter.section();
      text += fmt::format("\n[{}]\n", section);
    }
    const std::string assignment = fmt::format("{} = {}", parameter.name(), value_text(parameter, values));
    std::string comment;
    if (parameter.unit != "-") comment += fmt::format("{}; ", parameter.unit);
    if (!parameter.symbol.empty()) comment += fmt::format("{}; ", parameter.symbol);
    text += fmt::format("{:<44}  # {}{}\n", assignment, comment, parameter.description);
  }
  return text;
}

}  // namespace sphdrop
