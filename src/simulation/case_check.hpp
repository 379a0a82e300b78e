#pragma once
// What `--check` reports of a case.

#include <string>

#include "config/case.hpp"
#include "decomposition/communicator.hpp"
#include "setup/initial_state.hpp"

namespace sphdrop {

/// Collective. Particles, time step, steps, memory, expected time, partition quality and the case's dimensionless
/// numbers. Takes a few steps in memory to measure their cost; writes nothing.
std::string check_case(const Communicator& communicator, const Case& input, const InitialState& initial);

}  // namespace sphdrop
