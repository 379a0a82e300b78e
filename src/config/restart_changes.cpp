#include "config/restart_changes.hpp"

#include <algorithm>

#include "config/parameter_table.hpp"
#include "config/parameter_text.hpp"
#include "config/several_drops.hpp"

namespace sphdrop {

bool may_change_on_restart(std::string_view key) {
  if (key == "time.end") return true;
  for (const std::string_view section : {"output.", "checkpoint.", "parallel.", "safety."})
    if (key.starts_with(section)) return true;
  return false;
}

std::vector<ParameterChange> parameter_changes(const Case& before, const Case& after) {
  std::vector<ParameterChange> changes;
  const auto compare = [&](const Parameter& parameter, Which which, const Case& one, const Case& other) {
    std::string old_value = value_text(parameter, one), new_value = value_text(parameter, other);
    if (old_value != new_value)
      changes.push_back({key_of(parameter.key, which), std::move(old_value), std::move(new_value)});
  };
  for (const Parameter& parameter : parameter_table())
    if (parameter.key != "output.directory" && parameter.key != "drop.particles_file")
      compare(parameter, {}, before, after);
  if (before.more_drops.size() != after.more_drops.size())
    changes.push_back({"drop", std::to_string(before.drop_count()), std::to_string(after.drop_count())});
  for (std::size_t k = 1; k < std::min(before.drop_count(), after.drop_count()); ++k)
    for (const Parameter& parameter : parameter_table())
      if (parameter.section() == "drop" && parameter.key != "drop.particles_file")
        compare(parameter, {"drop", k}, before.with_drop(k), after.with_drop(k));
  if (before.more_solids.size() != after.more_solids.size())
    changes.push_back({"solid", std::to_string(before.solid_count()), std::to_string(after.solid_count())});
  for (std::size_t k = 1; k < std::min(before.solid_count(), after.solid_count()); ++k)
    for (const Parameter& parameter : parameter_table())
      if (parameter.section() == "solid") compare(parameter, {"solid", k}, before.with_solid(k), after.with_solid(k));
  return changes;
}

}  // namespace sphdrop
