#include "run/run_case.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "config/case_file.hpp"
#include "config/effective_case.hpp"
#include "config/parameter_store.hpp"
#include "io/checkpoint.hpp"
#include "run/exit_code.hpp"
#include "run/particle_file.hpp"
#include "run/recorded_run.hpp"
#include "run/say.hpp"
#include "run/shared_case.hpp"
#include "setup/initial_state.hpp"
#include "simulation/case_check.hpp"

namespace sphdrop {

namespace {

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

// Where a restart finds copies of a drop's particles that have gone: beside the checkpoint.
CopyFolders folders_of_copies(const CommandLine& command, const std::string& results_directory) {
  if (!command.restart) return {};
  const std::filesystem::path directory = command.output_directory.value_or(results_directory);
  if (*command.restart == "latest") return {directory};
  if (*command.restart == "auto") return find_checkpoints(directory).empty() ? CopyFolders{} : CopyFolders{directory};
  return {std::filesystem::path(*command.restart).parent_path(), directory};
}

}  // namespace

int run_case(const Communicator& communicator, const CommandLine& command, const std::vector<std::string>& arguments,
             std::chrono::steady_clock::time_point start) {
  const std::string text = shared_case_text(communicator, command.case_file);
  ParsedCase parsed = parse_case_text(text, command.case_file, command.overrides, [&](const ParticleRequest& request) {
    return shared_particles(communicator, request, folders_of_copies(command, request.results_directory));
  });
  Case& input = parsed.values;
  if (command.output_directory) input.output.directory = *command.output_directory;
  for (const std::string& warning : parsed.warnings) say(communicator, stderr, "warning: " + warning + "\n");
  if (command.action == CommandLine::Action::print) {
    say(communicator, stdout, effective_case_text(input));
    return success;
  }
  InitialState initial = build_initial_state(input, {communicator.rank(), communicator.size()});
  for (const std::string& warning : initial.warnings) say(communicator, stderr, "warning: " + warning + "\n");
  if (command.action == CommandLine::Action::check) {
    const std::string report = check_case(communicator, input, initial);
    say(communicator, stdout, report);
    return success;
  }

  RecordedRunOptions options;
  options.case_file = command.case_file;
  options.case_text = text;
  options.restart = command.restart;
  options.fresh = command.fresh;
  options.until = command.until;
  options.walltime_limit = walltime_limit(command, start);
  options.start = start;
  options.progress = command.quiet              ? Progress::Mode::quiet
                     : someone_watches_stderr() ? Progress::Mode::terminal
                                                : Progress::Mode::log;
  options.arguments = arguments;
  RecordedRun run(communicator, input, std::move(initial), options);
  const Simulation& simulation = run.simulation();
  if (simulation.time() < 0 && !command.quiet)
    say(communicator, stderr,
        fmt::format("the drop comes to rest for {:.6g} ms before t = 0; until then nothing is written\n",
                    -1e3 * simulation.time()));
  run.arrive();
  while (run.stopped().empty() && !run.is_at_end()) {
    run.go_on();
    run.arrive();
  }
  if (!run.stopped().empty()) {
    say(communicator, stderr,
        fmt::format("sphdrop: {}: stopped at step {}, t = {:.6g} s. To go on: --restart latest ({})\n", run.stopped(),
                    simulation.step(), simulation.time(), run.last_checkpoint().string()));
    return interrupted;
  }
  const RunSummary summary = run.finish();
  say(communicator, stdout,
      command.quiet ? fmt::format("state hash {:016x}\n", summary.state_hash) : summary_text(summary));
  return success;
}

}  // namespace sphdrop
