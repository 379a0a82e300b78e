#include "run/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "config/command_line.hpp"
#include "io/checkpoint.hpp"
#include "io/output_directory.hpp"
#include "run/particle_file.hpp"
#include "run/results_folder.hpp"
#include "run/say.hpp"

namespace sphdrop {

namespace {

// Whether there is a checkpoint that the user wants to go on from.
bool goes_on(const Communicator& communicator, const std::optional<std::string>& restart,
             const std::filesystem::path& directory) {
  if (!restart || *restart != "auto") return restart.has_value();
  std::vector<std::int64_t> found{static_cast<std::int64_t>(find_checkpoints(directory).size())};
  communicator.broadcast(found, 0);
  return found[0] > 0;
}

}  // namespace

RecordedRun::RecordedRun(const Communicator& communicator, const Case& input, InitialState initial,
                         const RecordedRunOptions& options)
    : communicator_(communicator),
      directory_(input.output.directory),
      end_(options.until ? std::min(*options.until, input.time.end) : input.time.end) {
  const Case recorded = with_copies(input);
  prepare_output_directory(communicator, directory_);
  refuse_to_overwrite_case(communicator, directory_, options.case_file, options.case_text, recorded);
  lock_.emplace(communicator, directory_);
  std::optional<Restart> restart;
  if (goes_on(communicator, options.restart, directory_)) {
    restart = find_restart(communicator, directory_, *options.restart == "auto" ? "latest" : *options.restart, input);
    for (const std::string& note : restart->notes) say(communicator, stderr, note + "\n");
  } else {
    if (!options.fresh) refuse_to_lose_checkpoints(communicator, directory_);
    remove_earlier_results(communicator, directory_);
  }
  write_copies(communicator, directory_, input);
  write_effective_case(communicator, directory_, recorded);
  record_.emplace(communicator, options.arguments);
  for (std::size_t k = 0; k < input.drop_count(); ++k) {
    const Case::Drop drop = input.with_drop(k).drop;
    if (!drop.given) continue;
    const std::string number = k == 0 ? "" : fmt::format("_{}", k + 1);
    record_->set("particles_file" + number, drop.given->path);
    record_->set("particles_checksum" + number, drop.given->checksum);
  }
  if (restart) {
    record_->set("restarted_from", restart->checkpoint.path.filename().string());
    record_->set("restarted_at_step", restart->checkpoint.header.step);
  }
  record_->write(communicator, directory_);

  simulation_ = std::make_unique<Simulation>(communicator, recorded, initial.fluid, initial.solid);
  initial = {};
  const Checkpoint* checkpoint = restart ? &restart->checkpoint : nullptr;
  if (checkpoint != nullptr) taking_up([&] { simulation_->restore(*checkpoint); });
  const RecorderOptions recording{directory_, end_, options.progress, version_text()};
  taking_up([&] { recorder_ = std::make_unique<Recorder>(*simulation_, recording, checkpoint); });
  checkpointer_ = std::make_unique<Checkpointer>(
      *simulation_, *recorder_,
      CheckpointerOptions{directory_, version_text(), build_info().git_commit, options.start, options.walltime_limit,
                          restart ? restart->checkpoint.path : std::filesystem::path()});
}

void RecordedRun::arrive() {
  try {
    simulation_->settle();
    stopped_ = checkpointer_->act();
    if (!stopped_.empty()) {
      recorder_->interrupt();
      record_->finish("interrupted: " + stopped_);
      record_->write(communicator_, directory_);
      return;
    }
    if (is_at_end()) checkpointer_->finish();
    simulation_->evaluate();
    recorder_->observe();
  } catch (const SafetyError& error) {
    record_unsafe_state(error);
  }
}

void RecordedRun::record_unsafe_state(const SafetyError& error) {
  const std::string last = recorder_->last_snapshot().string();
  std::string message = fmt::format("{}\nLast good snapshot: {}", error.what(), last.empty() ? "none" : last);
  record_->finish(std::string("stopped: ") + error.what());
  try {
    record_->write(communicator_, directory_);
  } catch (const RunRecordError& loss) {
    message += fmt::format("\nwarning: {}", loss.what());
  }
  throw SafetyError(message);
}

RunSummary RecordedRun::finish() {
  const std::uint64_t hash = recorder_->finish();
  RunSummary summary = recorder_->summary();
  summary.instructions = instruction_text(build_info());
  record_->set("particles", summary.particles);
  record_->set("steps", summary.steps);
  record_->set("simulated_time", summary.simulated_time);
  if (summary.drop && summary.drop->largest_mach_number)
    record_->set("largest_mach_number", summary.drop->largest_mach_number->value);
  record_->set("load_imbalance", summary.load_imbalance);
  record_->set("partition_imbalance", summary.partition_imbalance);
  for (const PhaseTime& phase : summary.phases) record_->set("seconds in " + phase.name, phase.seconds);
  for (const RankTraffic& traffic : summary.traffic) {
    if (traffic.occasion != "step") record_->set(traffic.occasion + "s", traffic.times);
    const auto set = [&](const char* what, double value) {
      record_->set(fmt::format("{} a {}", what, traffic.occasion), value);
    };
    set("messages", traffic.messages);
    set("message bytes", traffic.bytes);
    set("most messages", traffic.most_messages);
    set("most message bytes", traffic.most_bytes);
    set("collectives", traffic.collectives);
    set("collective bytes", traffic.collective_bytes);
  }
  record_->set("peak_memory", summary.peak_memory);
  record_->finish("completed", hash);
  record_->write(communicator_, directory_);
  return summary;
}

}  // namespace sphdrop
