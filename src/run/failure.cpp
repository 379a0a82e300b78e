#include "run/failure.hpp"

#include "config/case_error.hpp"
#include "io/checkpoint.hpp"
#include "io/history.hpp"
#include "io/output_directory.hpp"
#include "io/provenance.hpp"
#include "io/snapshot.hpp"
#include "run/restart.hpp"
#include "setup/setup_error.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {

namespace {

template <class... Errors>
bool is_one_of(const std::exception& error) {
  return (... || (dynamic_cast<const Errors*>(&error) != nullptr));
}

}  // namespace

std::optional<ExitCode> collective_failure(const std::exception& error) {
  if (is_one_of<CaseError, SetupError, OutputDirectoryError, RestartError>(error)) return user_error;
  if (is_one_of<SafetyError>(error)) return unsafe_state;
  if (is_one_of<CheckpointError, SnapshotError, HistoryError, RunRecordError>(error)) return output_error;
  return std::nullopt;
}

}  // namespace sphdrop
