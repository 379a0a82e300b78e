// MpiEnvironment must leave the signals of SignalBlock to the main thread alone (see there why).
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "decomposition/communicator.hpp"

namespace {

/// The signals a thread of this process blocks, a bit each.
std::uint64_t blocked_signals(const std::filesystem::path& task) {
  std::ifstream status(task / "status");
  for (std::string word; status >> word;)
    if (word == "SigBlk:" && status >> word) return std::stoull(word, nullptr, 16);
  return 0;
}

bool is_blocked(std::uint64_t mask, int signal) {
  return (mask >> (signal - 1) & 1U) != 0;
}

}  // namespace

int main(int argc, char** argv) {
  const sphdrop::MpiEnvironment environment(argc, argv);
  const sphdrop::Communicator communicator(MPI_COMM_WORLD);
  std::int64_t failures = 0;
  std::int64_t helpers = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const bool is_main = task.path().filename() == std::to_string(getpid());
    if (!is_main) ++helpers;
    const std::uint64_t blocked = blocked_signals(task.path());
    for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2})
      if (is_blocked(blocked, signal) == is_main) {
        std::fprintf(stderr, "signal %d is %s in the %s thread\n", signal, is_main ? "blocked" : "open",
                     is_main ? "main" : "helper");
        ++failures;
      }
  }
  if (communicator.rank() == 0) std::printf("%lld helper threads\n", static_cast<long long>(helpers));
  return communicator.sum(failures) == 0 ? 0 : 1;
}
