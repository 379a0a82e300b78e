#include "decomposition/signal_block.hpp"

#include <pthread.h>

#include <initializer_list>

namespace sphdrop {

SignalBlock::SignalBlock() : previous_{} {
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2}) sigaddset(&blocked, signal);
  pthread_sigmask(SIG_BLOCK, &blocked, &previous_);
}

SignalBlock::~SignalBlock() {
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

}  // namespace sphdrop
