#pragma once
// A file that no disk can refuse.

#include "io/posix_file.hpp"

namespace sphdrop {

/// A file in memory. Only what is written takes space; parts that are left out, however large, do not.
class MemoryFile {
 public:
  /// Throws std::system_error.
  MemoryFile();

  int descriptor() const { return file_.get(); }

  /// Writes what it holds to the same places of `target`, which gets its size. What was left out here stays there as it
  /// is: nothing, in a file that was empty. Throws std::system_error.
  void copy_to(FileDescriptor& target) const;

 private:
  FileDescriptor file_;
};

}  // namespace sphdrop
