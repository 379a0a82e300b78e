#pragma once
// A set of particles as a table of a checkpoint: which columns it has follows from the roles of their quantities.

#include <cstdint>
#include <string>
#include <string_view>

#include "io/checkpoint.hpp"
#include "particles/particle_set.hpp"

namespace sphdrop {

/// The owned rows' state, where it lies: to be used before the particles move.
class StoredParticles {
 public:
  /// `total`: rows over all ranks.
  StoredParticles(std::string_view name, const ParticleSet& particles, std::int64_t total);

  CheckpointTable table() const;

  /// This rank's part of a hash over every stored bit. The sum over all ranks modulo 2^64 depends neither on the order
  /// of the rows nor on who owns them.
  std::uint64_t hash() const;

 private:
  std::string name_;
  const ParticleSet& particles_;
  std::int64_t total_;
};

/// Takes this rank's rows of a checkpoint's table: afterwards all rows are owned. Throws CheckpointError if a column is
/// missing.
void restore_particles(const Checkpoint& checkpoint, std::string_view table, ParticleSet& particles);

}  // namespace sphdrop
