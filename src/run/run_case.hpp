#pragma once
// A case from its file to its results.

#include <chrono>
#include <string>
#include <vector>

#include "config/command_line.hpp"
#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Collective. Reads, checks and runs the case of the command line (`arguments`, for the record); `start` is the
/// program's. Returns an ExitCode; throws what its parts throw, on all ranks together.
int run_case(const Communicator& communicator, const CommandLine& command, const std::vector<std::string>& arguments,
             std::chrono::steady_clock::time_point start);

}  // namespace sphdrop
