// Signals must neither be lost nor disturb a partition while METIS, which traps some of them, is at work.
#include "decomposition/signal_block.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <numeric>
#include <thread>
#include <vector>

#include "decomposition/domain_partition.hpp"

namespace sphdrop {
namespace {

volatile std::sig_atomic_t handled = 0;

void count_signal(int, siginfo_t*, void*) {
  handled = handled + 1;
}

/// Installs count_signal for `signal` with a flag that ::signal() would lose.
class CountingHandler {
 public:
  explicit CountingHandler(int signal) : signal_(signal) {
    handled = 0;
    struct sigaction action = {};
    action.sa_sigaction = count_signal;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaddset(&action.sa_mask, SIGUSR2);
    sigaction(signal_, &action, &previous_);
  }
  ~CountingHandler() { sigaction(signal_, &previous_, nullptr); }
  CountingHandler(const CountingHandler&) = delete;
  CountingHandler& operator=(const CountingHandler&) = delete;

 private:
  int signal_;
  struct sigaction previous_ = {};
};

TEST(SignalBlock, HoldsSignalsBackAndDeliversThemAtItsEnd) {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2}) {
    const CountingHandler handler(signal);
    {
      const SignalBlock block;
      raise(signal);
      EXPECT_EQ(handled, 0) << signal;
    }
    EXPECT_EQ(handled, 1) << signal;
  }
}

TEST(PartitionGraph, NeitherSwallowsSignalsNorChangesTheirHandlers) {
  // A chain long enough for METIS to be at it for a while.
  constexpr std::int32_t vertices = 60000;
  std::vector<std::int32_t> row_starts{0};
  std::vector<std::int32_t> neighbours;
  for (std::int32_t v = 0; v < vertices; ++v) {
    if (v > 0) neighbours.push_back(v - 1);
    if (v + 1 < vertices) neighbours.push_back(v + 1);
    row_starts.push_back(static_cast<std::int32_t>(neighbours.size()));
  }
  const auto undisturbed = partition_graph(row_starts, neighbours, {}, {}, 4);

  const CountingHandler handler(SIGTERM);
  std::atomic<bool> done = false;
  std::atomic<int> sent = 0;
  const pthread_t target = pthread_self();
  std::thread sender([&] {
    while (!done) {
      pthread_kill(target, SIGTERM);
      ++sent;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  while (sent == 0) std::this_thread::yield();
  std::vector<std::int32_t> disturbed;
  std::string error;
  try {
    disturbed = partition_graph(row_starts, neighbours, {}, {}, 4);
  } catch (const std::exception& e) {
    error = e.what();
  }
  const int handled_during_and_after = handled;
  done = true;
  sender.join();
  EXPECT_EQ(error, "");
  EXPECT_EQ(disturbed, undisturbed);
  EXPECT_GE(handled_during_and_after, 1);

  struct sigaction now = {};
  sigaction(SIGTERM, nullptr, &now);
  EXPECT_EQ(now.sa_sigaction, count_signal);
  EXPECT_TRUE((now.sa_flags & SA_SIGINFO) != 0 && (now.sa_flags & SA_RESTART) != 0);
  EXPECT_EQ(sigismember(&now.sa_mask, SIGUSR2), 1);
}

}  // namespace
}  // namespace sphdrop
