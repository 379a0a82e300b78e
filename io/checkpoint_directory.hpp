#pragma once
// The names of checkpoints and how many are kept.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sphdrop {

/// "checkpoint_000000250000.h5".
std::string checkpoint_file_name(std::int64_t step);
bool is_checkpoint_file_name(std::string_view name);

/// Removes all checkpoints older than the newest `keep` up to `step`, those of later steps, and *.part files of any.
/// One that cannot be removed stays; the next call finds it again.
void remove_superseded_checkpoints(const std::filesystem::path& directory, std::int64_t step, int keep);

}  // namespace sphdrop
