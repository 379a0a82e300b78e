#pragma once
// What may differ between the case of a checkpoint and the case that goes on from it.

#include <string>
#include <string_view>
#include <vector>

#include "config/case.hpp"

namespace sphdrop {

/// A parameter with two values, as case files write them.
struct ParameterChange {
  std::string key, before, after;
};

/// Whether a restarted run may have another value of this parameter: when the run ends, what it writes and how it is
/// computed may change, what it computes may not.
bool may_change_on_restart(std::string_view key);

/// The parameters in which two cases differ, in the table's order; where the results or a
/// drop's file of particles lie does not count, what it holds does.
std::vector<ParameterChange> parameter_changes(const Case& before, const Case& after);

}  // namespace sphdrop
