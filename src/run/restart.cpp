#include "run/restart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/case_error.hpp"
#include "config/case_file.hpp"
#include "config/restart_changes.hpp"

namespace sphdrop {

namespace {

Case case_of(const Checkpoint& checkpoint) {
  return parse_case_text(checkpoint.header.case_text, "its case", {}).values;
}

/// What f() returns; a checkpoint that cannot be had is told with what else there is to do.
template <class F>
auto advised(const std::string& advice, F&& f) {
  try {
    return f();
  } catch (const CheckpointError& error) {
    throw CheckpointError(fmt::format("{}; {}", error.what(), advice));
  }
}

std::string change_text(const ParameterChange& change) {
  if (change.key.ends_with(".particles_checksum"))
    return fmt::format("{} was {}, is now {}: the drop's file holds something else", change.key, change.before,
                       change.after);
  return fmt::format("{} was {}, is now {}", change.key, change.before, change.after);
}

}  // namespace

std::string restart_objection(const Checkpoint& checkpoint, const Case& input) {
  std::vector<std::string> refused;
  try {
    for (const ParameterChange& change : parameter_changes(case_of(checkpoint), input))
      if (!may_change_on_restart(change.key)) refused.push_back(change_text(change));
  } catch (const CaseError& error) {
    return fmt::format("holds a case that this version does not understand: {}", error.what());
  }
  if (refused.empty()) return {};
  return fmt::format(
      "is of another case: {} (only time.end and the sections output, checkpoint, parallel and safety may "
      "change on a restart)",
      fmt::join(refused, "; "));
}

Restart find_restart(const Communicator& communicator, const std::filesystem::path& directory,
                     const std::string& choice, const Case& input) {
  Restart restart;
  taking_up([&] {
    if (choice == "latest") {
      LatestCheckpoint latest = advised("--fresh instead of --restart begins anew",
                                        [&] { return read_latest_checkpoint(communicator, directory); });
      restart.checkpoint = std::move(latest.checkpoint);
      for (const std::string& why : latest.refused) restart.notes.push_back("warning: passed over " + why);
    } else {
      const bool is_word = choice.find_first_of("./") == std::string::npos;
      const auto read = [&] { return read_checkpoint(communicator, choice); };
      restart.checkpoint = is_word ? advised("--restart takes latest, auto or a checkpoint's file", read) : read();
    }
    // Older ones in the same folder are of the same run, and so of the same case.
    if (const std::string objection = restart_objection(restart.checkpoint, input); !objection.empty())
      throw CheckpointError(fmt::format("{} {}", restart.checkpoint.path.string(), objection));
  });
  for (const ParameterChange& change : parameter_changes(case_of(restart.checkpoint), input))
    restart.notes.push_back("note: " + change_text(change));
  return restart;
}

}  // namespace sphdrop
