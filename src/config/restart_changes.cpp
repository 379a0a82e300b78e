#include "config/restart_changes.hpp"

#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"

namespace sphdrop {

bool may_change_on_restart(std::string_view key) {
  if (key == "time.end") return true;
  for (const std::string_view section : {"output.", "checkpoint.", "parallel.", "safety."})
    if (key.starts_with(section)) return true;
  return false;
}

std::vector<ParameterChange> parameter_changes(const Case& before, const Case& after) {
  std::vector<ParameterChange> changes;
  for (const Parameter& parameter : parameter_table()) {
    if (parameter.key == "output.directory") continue;
    std::string old_value = value_text(parameter, before), new_value = value_text(parameter, after);
    if (old_value != new_value)
      changes.push_back({std::string(parameter.key), std::move(old_value), std::move(new_value)});
  }
  return changes;
}

}  // namespace sphdrop
