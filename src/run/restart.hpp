#pragma once
// Which checkpoint a run goes on from, and whether it may.

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "io/checkpoint.hpp"

namespace sphdrop {

/// There is no checkpoint to go on from, or it is not one of this case; thrown on all ranks with the same text.
struct RestartError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What `f` returns; a checkpoint that turns out not to be usable while it is taken up becomes a RestartError.
template <class F>
decltype(auto) taking_up(F&& f) {
  try {
    return f();
  } catch (const CheckpointError& error) {
    throw RestartError(fmt::format("cannot go on: {}", error.what()));
  }
}

struct Restart {
  Checkpoint checkpoint;
  std::vector<std::string> notes;  ///< for the user: checkpoints passed over, parameters that have changed
};

/// Collective. `choice` is "latest", the newest checkpoint in `directory` that can be read, or a file's path. Throws
/// RestartError.
Restart find_restart(const Communicator& communicator, const std::filesystem::path& directory,
                     const std::string& choice, const Case& input);

/// What speaks against going on from the checkpoint with this case; empty if nothing does.
std::string restart_objection(const Checkpoint& checkpoint, const Case& input);

}  // namespace sphdrop
