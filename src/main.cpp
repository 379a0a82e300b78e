// sphdrop: MPI, command line, case, run, errors.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "config/case_file.hpp"
#include "config/command_line.hpp"
#include "config/effective_case.hpp"
#include "config/toml_source.hpp"
#include "decomposition/communicator.hpp"
#include "decomposition/stop_signal.hpp"
#include "io/output_directory.hpp"
#include "io/provenance.hpp"
#include "io/run_lock.hpp"
#include "setup/initial_state.hpp"
#include "setup/setup_error.hpp"
#include "simulation/case_check.hpp"
#include "simulation/checkpointer.hpp"
#include "simulation/recorder.hpp"
#include "simulation/restart.hpp"

namespace {

using namespace sphdrop;

enum ExitCode {
  success = 0,
  internal_error = 1,
  user_error = 2,
  unsafe_state = 3,
  output_error = 4,
  interrupted = 5  // stopped in good order: go on with --restart latest
};

// The text of the case file, read by rank 0 alone; its mistakes are thrown on all ranks.
std::string shared_case_text(const Communicator& communicator, const std::string& path) {
  std::string text;
  std::vector<std::string> mistakes;
  if (communicator.rank() == 0) {
    try {
      text = read_text_file(path);
    } catch (const CaseError& error) {
      mistakes = error.mistakes();
    }
  }
  std::string joined = fmt::format("{}", fmt::join(mistakes, "\n"));
  communicator.broadcast(joined, 0);
  if (!joined.empty()) throw CaseError({joined});
  communicator.broadcast(text, 0);
  return text;
}

void say(const Communicator& communicator, std::FILE* stream, const std::string& text) {
  if (communicator.rank() != 0) return;
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

// Whether standard error ends on a terminal. Under mpirun it is a pipe to it, so its own standard error is looked at.
bool someone_watches_stderr() {
  if (isatty(STDERR_FILENO)) return true;
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return false;
  std::error_code unknown;
  const auto target = std::filesystem::read_symlink(fmt::format("/proc/{}/fd/2", getppid()), unknown);
  return !unknown && target.string().starts_with("/dev/pts/");
}

// The effective case is written as case.cfg, which may be the very file the user wrote: `--output .` beside it.
void refuse_to_overwrite_case(const Communicator& communicator, const std::filesystem::path& directory,
                              const std::string& case_file, const std::string& case_text, const Case& input) {
  std::string error;
  if (communicator.rank() == 0) {
    std::error_code not_there;
    const bool is_same = std::filesystem::equivalent(directory / "case.cfg", case_file, not_there);
    if (is_same && case_text != effective_case_text(input))
      error = fmt::format("the results in {} would replace the case file {} itself; choose another --output",
                          directory.string(), case_file);
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

// Checkpoints of a run that did not come to its end are not thrown away because someone forgot to write --restart.
void refuse_to_lose_checkpoints(const Communicator& communicator, const std::filesystem::path& directory) {
  std::string error;
  if (communicator.rank() == 0) {
    std::ifstream file(directory / "run.json");
    const std::string record{std::istreambuf_iterator<char>(file), {}};
    const bool came_to_its_end = record.find("\"status\": \"completed\"") != std::string::npos;
    const std::vector<std::filesystem::path> checkpoints = find_checkpoints(directory);
    if (!checkpoints.empty() && !came_to_its_end)
      error = fmt::format(
          "{} holds checkpoints of a run that is not finished, the newest {}: go on with --restart latest, "
          "start anew with --fresh, or choose another --output",
          directory.string(), checkpoints.front().filename().string());
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

// A run starts with an empty folder: snapshots of an earlier, longer run would mix with its own.
void remove_earlier_results(const Communicator& communicator, const std::filesystem::path& directory) {
  std::string error;
  if (communicator.rank() == 0) {
    try {
      const std::vector<std::filesystem::path> files = results_in(directory);
      for (const std::filesystem::path& file : files) std::filesystem::remove(file);
      if (!files.empty())
        fmt::print(stderr, "note: replacing the {} result files of an earlier run in {}\n", files.size(),
                   directory.string());
    } catch (const std::exception& e) {
      error = e.what();
    }
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

void write_effective_case(const Communicator& communicator, const std::filesystem::path& directory, const Case& input) {
  std::string error;
  if (communicator.rank() == 0) {
    std::ofstream file(directory / "case.cfg");
    file << effective_case_text(input) << std::flush;
    if (!file) error = fmt::format("cannot write {}", (directory / "case.cfg").string());
  }
  communicator.broadcast(error, 0);
  if (!error.empty()) throw OutputDirectoryError(error);
}

// Whether there is a checkpoint that the user wants to go on from.
bool goes_on(const Communicator& communicator, const CommandLine& command, const std::filesystem::path& directory) {
  if (!command.restart || *command.restart != "auto") return command.restart.has_value();
  std::vector<std::int64_t> found{static_cast<std::int64_t>(find_checkpoints(directory).size())};
  communicator.broadcast(found, 0);
  return found[0] > 0;
}

int run_case(const Communicator& communicator, const CommandLine& command, const std::vector<std::string>& arguments,
             std::chrono::steady_clock::time_point start) {
  const std::string text = shared_case_text(communicator, command.case_file);
  ParsedCase parsed = parse_case_text(text, command.case_file, command.overrides);
  Case& input = parsed.values;
  if (command.output_directory) input.output.directory = *command.output_directory;
  for (const std::string& warning : parsed.warnings) say(communicator, stderr, "warning: " + warning + "\n");
  const InitialState initial = build_initial_state(input);
  if (command.action == CommandLine::Action::check) {
    const std::string report = check_case(communicator, input, initial);
    say(communicator, stdout, report);
    return success;
  }

  const std::filesystem::path directory = input.output.directory;
  prepare_output_directory(communicator, directory);
  refuse_to_overwrite_case(communicator, directory, command.case_file, text, input);
  const RunLock lock(communicator, directory);
  std::optional<Restart> restart;
  if (goes_on(communicator, command, directory)) {
    restart = find_restart(communicator, directory, *command.restart == "auto" ? "latest" : *command.restart, input);
    for (const std::string& note : restart->notes) say(communicator, stderr, note + "\n");
  } else {
    if (!command.fresh) refuse_to_lose_checkpoints(communicator, directory);
    remove_earlier_results(communicator, directory);
  }
  write_effective_case(communicator, directory, input);
  RunRecord record(communicator, arguments);
  if (restart) {
    record.set("restarted_from", restart->checkpoint.path.filename().string());
    record.set("restarted_at_step", restart->checkpoint.header.step);
  }
  record.write(directory);

  Simulation simulation(communicator, input, initial.fluid, initial.solid);
  if (restart) simulation.restore(restart->checkpoint);
  RecorderOptions options;
  options.directory = directory;
  options.end_time = command.until ? std::min(*command.until, input.time.end) : input.time.end;
  options.version = version_text();
  options.progress = command.quiet              ? Progress::Mode::quiet
                     : someone_watches_stderr() ? Progress::Mode::terminal
                                                : Progress::Mode::log;
  Recorder recorder(simulation, options, restart ? &restart->checkpoint : nullptr);
  Checkpointer checkpointer(simulation, recorder,
                            {directory, version_text(), build_info().git_commit, start, command.max_walltime});
  restart.reset();
  try {
    for (;;) {
      simulation.settle();
      if (const std::string why = checkpointer.act(); !why.empty()) {
        recorder.interrupt();
        record.finish("interrupted: " + why);
        record.write(directory);
        say(communicator, stderr,
            fmt::format("sphdrop: {}: stopped at step {}, t = {:.6g} s. To go on: --restart latest ({})\n", why,
                        simulation.step(), simulation.time(), checkpointer.last_checkpoint().string()));
        return interrupted;
      }
      const bool is_last = simulation.time() >= options.end_time;
      if (is_last) checkpointer.finish();
      simulation.evaluate();
      recorder.observe();
      if (is_last) break;
      simulation.move(checkpointer.wish());
    }
  } catch (const SafetyError& error) {
    const std::string& last = recorder.last_snapshot().string();
    record.finish(std::string("stopped: ") + error.what());
    record.write(directory);
    throw SafetyError(fmt::format("{}\nLast good snapshot: {}", error.what(), last.empty() ? "none" : last));
  }
  const std::uint64_t hash = recorder.finish();
  const RunSummary summary = recorder.summary();
  record.set("particles", summary.particles);
  record.set("steps", summary.steps);
  record.set("simulated_time", summary.simulated_time);
  record.set("load_imbalance", summary.load_imbalance);
  for (const PhaseTime& phase : summary.phases) record.set("seconds in " + phase.name, phase.seconds);
  record.finish("completed", hash);
  record.write(directory);
  say(communicator, stdout, command.quiet ? fmt::format("state hash {:016x}\n", hash) : summary_text(summary));
  return success;
}

}  // namespace

int main(int argc, char** argv) {
  const auto start = std::chrono::steady_clock::now();
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
    catch_stop_signals();
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
  } catch (const std::exception& error) {
    fmt::print(stderr, "sphdrop: rank {}: internal error: {}\n", communicator.rank(), error.what());
    MPI_Abort(MPI_COMM_WORLD, internal_error);
  }
  return internal_error;
}
