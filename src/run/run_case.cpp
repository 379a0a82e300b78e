#include "run/run_case.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "config/case_error.hpp"
#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "config/parameter_store.hpp"
#include "config/toml_source.hpp"
#include "io/output_directory.hpp"
#include "io/provenance.hpp"
#include "io/run_lock.hpp"
#include "run/checkpointer.hpp"
#include "run/exit_code.hpp"
#include "run/restart.hpp"
#include "run/results_folder.hpp"
#include "run/say.hpp"
#include "setup/initial_state.hpp"
#include "simulation/case_check.hpp"
#include "simulation/recorder.hpp"

namespace sphdrop {

namespace {

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

// Whether standard error ends on a terminal. Under mpirun it is a pipe to it, so its own standard error is looked at.
bool someone_watches_stderr() {
  if (isatty(STDERR_FILENO)) return true;
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return false;
  std::error_code unknown;
  const auto target = std::filesystem::read_symlink(fmt::format("/proc/{}/fd/2", getppid()), unknown);
  return !unknown && target.string().starts_with("/dev/pts/");
}

// When the run must be over, s after the program's start: what the user allows, and when Slurm ends the job.
std::optional<double> walltime_limit(const CommandLine& command, std::chrono::steady_clock::time_point start) {
  std::optional<double> limit = command.max_walltime;
  const char* job_end = std::getenv("SLURM_JOB_END_TIME");  // UNIX time, s
  const std::optional<double> end = job_end == nullptr ? std::nullopt : parse_number(job_end);
  if (!end) return limit;
  const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const double job_limit = elapsed.count() + *end - now.count();
  return std::min(limit.value_or(job_limit), job_limit);
}

// Whether there is a checkpoint that the user wants to go on from.
bool goes_on(const Communicator& communicator, const CommandLine& command, const std::filesystem::path& directory) {
  if (!command.restart || *command.restart != "auto") return command.restart.has_value();
  std::vector<std::int64_t> found{static_cast<std::int64_t>(find_checkpoints(directory).size())};
  communicator.broadcast(found, 0);
  return found[0] > 0;
}

}  // namespace

int run_case(const Communicator& communicator, const CommandLine& command, const std::vector<std::string>& arguments,
             std::chrono::steady_clock::time_point start) {
  const std::string text = shared_case_text(communicator, command.case_file);
  ParsedCase parsed = parse_case_text(text, command.case_file, command.overrides);
  Case& input = parsed.values;
  if (command.output_directory) input.output.directory = *command.output_directory;
  for (const std::string& warning : parsed.warnings) say(communicator, stderr, "warning: " + warning + "\n");
  if (command.action == CommandLine::Action::print) {
    say(communicator, stdout, effective_case_text(input));
    return success;
  }
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
  record.write(communicator, directory);

  Simulation simulation(communicator, input, initial.fluid, initial.solid);
  if (restart) taking_up([&] { simulation.restore(restart->checkpoint); });
  RecorderOptions options;
  options.directory = directory;
  options.end_time = command.until ? std::min(*command.until, input.time.end) : input.time.end;
  options.version = version_text();
  options.progress = command.quiet              ? Progress::Mode::quiet
                     : someone_watches_stderr() ? Progress::Mode::terminal
                                                : Progress::Mode::log;
  Recorder recorder =
      taking_up([&] { return Recorder(simulation, options, restart ? &restart->checkpoint : nullptr); });
  Checkpointer checkpointer(simulation, recorder,
                            {directory, version_text(), build_info().git_commit, start, walltime_limit(command, start),
                             restart ? restart->checkpoint.path : std::filesystem::path()});
  restart.reset();
  if (simulation.time() < 0 && !command.quiet)
    say(communicator, stderr,
        fmt::format("the drop comes to rest for {:.6g} ms before t = 0; until then nothing is written\n",
                    -1e3 * simulation.time()));
  try {
    for (;;) {
      simulation.settle();
      if (const std::string why = checkpointer.act(); !why.empty()) {
        recorder.interrupt();
        record.finish("interrupted: " + why);
        record.write(communicator, directory);
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
    const std::string last = recorder.last_snapshot().string();
    std::string message = fmt::format("{}\nLast good snapshot: {}", error.what(), last.empty() ? "none" : last);
    record.finish(std::string("stopped: ") + error.what());
    try {
      record.write(communicator, directory);
    } catch (const RunRecordError& loss) {
      message += fmt::format("\nwarning: {}", loss.what());
    }
    throw SafetyError(message);
  }
  const std::uint64_t hash = recorder.finish();
  const RunSummary summary = recorder.summary();
  record.set("particles", summary.particles);
  record.set("steps", summary.steps);
  record.set("simulated_time", summary.simulated_time);
  record.set("load_imbalance", summary.load_imbalance);
  for (const PhaseTime& phase : summary.phases) record.set("seconds in " + phase.name, phase.seconds);
  record.finish("completed", hash);
  record.write(communicator, directory);
  say(communicator, stdout, command.quiet ? fmt::format("state hash {:016x}\n", hash) : summary_text(summary));
  return success;
}

}  // namespace sphdrop
