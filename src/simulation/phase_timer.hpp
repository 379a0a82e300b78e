#pragma once
// Where the wall time and the traffic go.

#include <mpi.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "decomposition/communicator.hpp"

namespace sphdrop {

enum class Phase {
  fluid_sweep,
  solid_sweep,
  update,
  surface_tension,
  contact,
  communication,
  detection,
  redistribution,
  output
};
inline constexpr std::array<std::string_view, 9> phase_names{"fluid sweep",       "solid sweep",    "update",
                                                             "surface tension",   "contact",        "communication",
                                                             "surface detection", "redistribution", "output"};

/// Seconds and traffic by phase on this rank. Everything between two calls of lap() belongs to the phase named at the
/// second.
class PhaseTimer {
 public:
  /// The communicator must outlive it.
  explicit PhaseTimer(const Communicator& communicator) : communicator_(&communicator) {}

  void start() {
    last_ = MPI_Wtime();
    last_traffic_ = communicator_->traffic();
  }
  void lap(Phase phase) {
    const auto k = static_cast<std::size_t>(phase);
    const double now = MPI_Wtime();
    seconds_[k] += now - last_;
    last_ = now;
    if (communicator_->traffic() == last_traffic_) return;
    traffic_[k] += communicator_->traffic() - last_traffic_;
    last_traffic_ = communicator_->traffic();
  }
  const std::array<double, phase_names.size()>& seconds() const { return seconds_; }
  const Traffic& traffic(Phase phase) const { return traffic_[static_cast<std::size_t>(phase)]; }
  /// Of all phases that belong to every step.
  Traffic traffic_of_steps() const {
    Traffic sum;
    for (std::size_t k = 0; k < static_cast<std::size_t>(Phase::detection); ++k) sum += traffic_[k];
    return sum;
  }

 private:
  const Communicator* communicator_;
  double last_ = 0;
  Traffic last_traffic_;
  std::array<double, phase_names.size()> seconds_{};
  std::array<Traffic, phase_names.size()> traffic_{};
};

}  // namespace sphdrop
