#pragma once
// What a run does to the folder of its results before it begins. All of it is collective, and all of it throws
// OutputDirectoryError on all ranks.

#include <filesystem>
#include <string>

#include "config/case.hpp"
#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Throws if the effective case would replace the user's own file of another text: `--output .` beside it.
void refuse_to_overwrite_case(const Communicator& communicator, const std::filesystem::path& directory,
                              const std::string& case_file, const std::string& case_text, const Case& input);

/// Throws if the folder holds checkpoints of a run that did not come to its end.
void refuse_to_lose_checkpoints(const Communicator& communicator, const std::filesystem::path& directory);

/// A run starts with an empty folder: snapshots of an earlier, longer run would mix with its own.
void remove_earlier_results(const Communicator& communicator, const std::filesystem::path& directory);

/// Writes case.cfg.
void write_effective_case(const Communicator& communicator, const std::filesystem::path& directory, const Case& input);

}  // namespace sphdrop
