// sphdrop: MPI, command line, run, errors.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>

#include "config/case_error.hpp"
#include "config/command_line.hpp"
#include "decomposition/communicator.hpp"
#include "decomposition/stop_signal.hpp"
#include "io/checkpoint.hpp"
#include "io/history.hpp"
#include "io/output_directory.hpp"
#include "io/provenance.hpp"
#include "io/snapshot.hpp"
#include "run/exit_code.hpp"
#include "run/restart.hpp"
#include "run/run_case.hpp"
#include "run/say.hpp"
#include "setup/setup_error.hpp"
#include "simulation/simulation.hpp"

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
    say(communicator, stdout, fmt::format("sphdrop {}, commit {}\n", version_text(), build_info().git_commit));
    return success;
  }
  // These are thrown on all ranks together, so all can leave in good order; anything else is one rank's own trouble.
  const auto fail = [&](ExitCode code, const std::exception& error) {
    say(communicator, stderr, fmt::format("sphdrop: {}\n", error.what()));
    return static_cast<int>(code);
  };
  try {
    return run_case(communicator, command, {argv, argv + argc}, start);
  } catch (const CaseError& error) {
    return fail(user_error, error);
  } catch (const SetupError& error) {
    return fail(user_error, error);
  } catch (const OutputDirectoryError& error) {
    return fail(user_error, error);
  } catch (const RestartError& error) {
    return fail(user_error, error);
  } catch (const SafetyError& error) {
    return fail(unsafe_state, error);
  } catch (const CheckpointError& error) {
    return fail(output_error, error);
  } catch (const SnapshotError& error) {
    return fail(output_error, error);
  } catch (const HistoryError& error) {
    return fail(output_error, error);
  } catch (const RunRecordError& error) {
    return fail(output_error, error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "sphdrop: rank {}: internal error: {}\n", communicator.rank(), error.what());
    MPI_Abort(MPI_COMM_WORLD, internal_error);
  }
  return internal_error;
}
