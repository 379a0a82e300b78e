#pragma once
// What a simulation is in a checkpoint: its particles and a few numbers.

#include <cstdint>
#include <span>
#include <vector>

#include "io/checkpoint.hpp"
#include "simulation/stored_particles.hpp"

namespace sphdrop {

/// The state between two steps; of the particles not a copy, so that it is to be used before they move.
struct SavedSimulation {
  StoredParticles fluid, solid;
  std::vector<CheckpointNumbers> numbers;  ///< the same on every rank

  /// This rank's part of a hash over every bit of the particles' state; sums over the ranks modulo 2^64.
  std::uint64_t hash() const { return fluid.hash() + solid.hash(); }
};

/// Where a run is.
struct Clock {
  double time = 0;  ///< s
  std::int64_t step = 0;
  double previous_step = 0;  ///< length of the last step, s
};

CheckpointNumbers clock_numbers(const Clock& clock);

/// Throws std::invalid_argument where the numbers are not of clock_numbers().
Clock clock_of(std::span<const double> numbers);

}  // namespace sphdrop
