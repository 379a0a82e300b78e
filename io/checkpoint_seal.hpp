#pragma once
// Puts a checkpoint's head in its place.

#include <filesystem>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Collective. Writes size and checksum of the file, whose HDF5 part is complete, into its head. Throws
/// CollectiveError.
void seal_checkpoint(const Communicator& communicator, const std::filesystem::path& path);

}  // namespace sphdrop
