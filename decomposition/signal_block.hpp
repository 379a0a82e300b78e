#pragma once
// Keeps the signals that ask a run to stop or to checkpoint away from code that must not see them.

#include <csignal>

namespace sphdrop {

/// Blocks SIGTERM, SIGINT, SIGUSR1 and SIGUSR2 in the calling thread while it lives; one that arrives meanwhile stays
/// pending and is delivered afterwards. Threads started meanwhile inherit the block for good.
class SignalBlock {
 public:
  SignalBlock();
  ~SignalBlock();
  SignalBlock(const SignalBlock&) = delete;
  SignalBlock& operator=(const SignalBlock&) = delete;

 private:
  sigset_t previous_;
};

}  // namespace sphdrop
