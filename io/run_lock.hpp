#pragma once
// One run at a time into a folder.

#include <filesystem>
#include <optional>

#include "decomposition/communicator.hpp"
#include "io/posix_file.hpp"

namespace sphdrop {

/// Holds `directory`/run.lock locked as long as it lives; the system lets go of it when the program ends, however it
/// ends. The file stays and says who had it last.
class RunLock {
 public:
  /// Collective. Throws OutputDirectoryError on all ranks if another run has the lock.
  RunLock(const Communicator& communicator, const std::filesystem::path& directory);

 private:
  std::optional<FileDescriptor> file_;  // on rank 0
};

}  // namespace sphdrop
