#pragma once
// Which exceptions are whose.

#include <exception>
#include <optional>

#include "run/exit_code.hpp"

namespace sphdrop {

/// user_error, unsafe_state or output_error for what is thrown on all ranks together, so that all can leave in good
/// order; empty for anything else, which is one rank's own trouble.
std::optional<ExitCode> collective_failure(const std::exception& error);

}  // namespace sphdrop
