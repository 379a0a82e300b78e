#pragma once
// What is said is said once.

#include <cstdio>
#include <string>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Rank 0 writes the text and flushes the stream.
inline void say(const Communicator& communicator, std::FILE* stream, const std::string& text) {
  if (communicator.rank() != 0) return;
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

}  // namespace sphdrop
