#pragma once
// Checks of drops whose particles a file gives.

#include <vector>

#include "config/check.hpp"

namespace sphdrop {

/// What makes them impossible.
const std::vector<Check>& drop_contradictions();

}  // namespace sphdrop
