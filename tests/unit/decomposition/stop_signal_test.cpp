// A signal that asks to stop is remembered and does nothing else.
#include "decomposition/stop_signal.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace sphdrop {
namespace {

// In a process of its own, so that this one's handlers and memory of signals stay as they are.
template <class F>
int exit_code_of(F&& f) {
  const pid_t child = fork();
  if (child == 0) _exit(f());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StopSignal, IsRememberedAndDoesNothingElse) {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2})
    EXPECT_EQ(exit_code_of([signal] {
                catch_stop_signals();
                if (caught_stop_signal() != 0) return 1;
                raise(signal);
                return caught_stop_signal() == signal ? 0 : 2;
              }),
              0)
        << signal_name(signal);
}

TEST(StopSignal, TheLastOneCounts) {
  EXPECT_EQ(exit_code_of([] {
              catch_stop_signals();
              raise(SIGUSR1);
              raise(SIGTERM);
              return caught_stop_signal() == SIGTERM ? 0 : 1;
            }),
            0);
}

TEST(StopSignal, HasAName) {
  EXPECT_EQ(signal_name(SIGTERM), "SIGTERM");
  EXPECT_EQ(signal_name(SIGUSR2), "SIGUSR2");
  EXPECT_EQ(signal_name(SIGSEGV), "a signal");
}

}  // namespace
}  // namespace sphdrop
