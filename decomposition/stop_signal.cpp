#include "decomposition/stop_signal.hpp"

#include <csignal>
#include <initializer_list>

namespace sphdrop {

namespace {

volatile std::sig_atomic_t caught = 0;

void remember(int signal) {
  caught = signal;
}

}  // namespace

void catch_stop_signals() {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2}) {
    struct sigaction action = {};
    action.sa_handler = remember;
    sigemptyset(&action.sa_mask);
    // Calls that the signal interrupts go on by themselves: output must not fail for it.
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

int caught_stop_signal() {
  return caught;
}

std::string_view signal_name(int signal) {
  switch (signal) {
    case SIGTERM:
      return "SIGTERM";
    case SIGINT:
      return "SIGINT";
    case SIGUSR1:
      return "SIGUSR1";
    case SIGUSR2:
      return "SIGUSR2";
    default:
      return "a signal";
  }
}

}  // namespace sphdrop
