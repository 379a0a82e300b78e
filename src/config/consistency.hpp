#pragma once
// Checks that involve several parameters at once. Each alone is within its range by now.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "config/case.hpp"

namespace sphdrop {

struct Finding {
  std::vector<std::string_view> keys;  ///< the parameters involved, the one to change first
  std::string message;
};

/// Whether a parameter has a valid value. Checks on others are left out.
using IsUsable = std::function<bool(std::string_view key)>;

/// What makes the case impossible. Expects derived defaults to be filled in.
std::vector<Finding> contradictions(const Case& values, const IsUsable& is_usable);

/// What the case may hold but its author should know.
std::vector<Finding> doubts(const Case& values);

}  // namespace sphdrop
