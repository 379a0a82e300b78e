#pragma once
// Where the wall time goes.

#include <mpi.h>

#include <array>
#include <cstddef>
#include <string_view>

namespace sphdrop {

enum class Phase { fluid_sweep, solid_sweep, update, surface_tension, contact, communication, redistribution, output };
inline constexpr std::array<std::string_view, 8> phase_names{
    "fluid sweep", "solid sweep", "update", "surface tension", "contact", "communication", "redistribution", "output"};

/// Seconds by phase on this rank. Everything between two calls of lap() belongs to the phase named at the second.
class PhaseTimer {
 public:
  void start() { last_ = MPI_Wtime(); }
  void lap(Phase phase) {
    const double now = MPI_Wtime();
    seconds_[static_cast<std::size_t>(phase)] += now - last_;
    last_ = now;
  }
  const std::array<double, phase_names.size()>& seconds() const { return seconds_; }

 private:
  double last_ = 0;
  std::array<double, phase_names.size()> seconds_{};
};

}  // namespace sphdrop
