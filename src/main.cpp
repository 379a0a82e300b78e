// sphdrop: MPI, command line, run, errors.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>

#include "config/command_line.hpp"
#include "decomposition/communicator.hpp"
#include "decomposition/stop_signal.hpp"
#include "io/build_info.hpp"
#include "run/exit_code.hpp"
#include "run/failure.hpp"
#include "run/run_case.hpp"
#include "run/say.hpp"

int main(int argc, char** argv) {
  using namespace sphdrop;
  const auto start = std::chrono::steady_clock::now();
  catch_stop_signals();
  MpiEnvironment environment(argc, argv);
  const Communicator communicator(MPI_COMM_WORLD);
  const CommandLine command = parse_command_line(argc, argv);
  if (command.action == CommandLine::Action::finish) {
    say(communicator, command.exit_code == 0 ? stdout : stderr, command.text);
    return command.exit_code;
  }
  if (command.action == CommandLine::Action::version) {
    say(communicator, stdout,
        fmt::format("sphdrop {}, commit {}, {}\n", version_text(), build_info().git_commit,
                    instruction_text(build_info())));
    return success;
  }
  try {
    return run_case(communicator, command, {argv, argv + argc}, start);
  } catch (const std::exception& error) {
    if (const std::optional<ExitCode> code = collective_failure(error)) {
      say(communicator, stderr, fmt::format("sphdrop: {}\n", error.what()));
      return *code;
    }
    fmt::print(stderr, "sphdrop: rank {}: internal error: {}\n", communicator.rank(), error.what());
    MPI_Abort(MPI_COMM_WORLD, internal_error);
  }
  return internal_error;
}
