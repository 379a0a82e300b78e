#pragma once
// Where the results go.

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "decomposition/communicator.hpp"

namespace sphdrop {

class OutputDirectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Creates `directory` and its parents and makes sure that files can be written there. Throws OutputDirectoryError,
/// whose text says what is in the way and what to do.
void create_writable_directory(const std::filesystem::path& directory);

/// Collective. create_writable_directory() on rank 0; then every rank makes sure that it sees the directory (on several
/// hosts it must lie on a shared file system). Throws OutputDirectoryError with the same text on all ranks.
void prepare_output_directory(const Communicator& communicator, const std::filesystem::path& directory);

/// The files in `directory` that a run wrote, ascending: snapshots and their index, checkpoints, history, run.json,
/// and *.part files of these left by a crash. Files of other names are none of ours.
std::vector<std::filesystem::path> results_in(const std::filesystem::path& directory);

}  // namespace sphdrop
