#pragma once
// Checks of the solids' shapes, holds and number.

#include <vector>

#include "config/check.hpp"

namespace sphdrop {

/// What makes them impossible.
const std::vector<Check>& solid_contradictions();

/// What their author should know.
const std::vector<Check>& solid_doubts();

}  // namespace sphdrop
