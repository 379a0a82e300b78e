#pragma once
// A set of particles as a table of a checkpoint: which columns it has follows from the roles of their quantities.

#include <string>
#include <string_view>
#include <vector>

#include "io/checkpoint.hpp"
#include "particles/particle_set.hpp"

namespace sphdrop {

/// A copy of the owned rows' state.
class StoredParticles {
 public:
  /// `total`: rows over all ranks.
  StoredParticles(std::string_view name, const ParticleSet& particles, std::int64_t total);

  /// Refers to this object.
  CheckpointTable table() const;

  /// This rank's part of a hash over every stored bit. The sum over all ranks modulo 2^64 depends neither on the order
  /// of the rows nor on who owns them.
  std::uint64_t hash() const;

 private:
  struct StoredColumn {
    std::string name, unit, description;
    std::vector<double> values;
  };

  std::string name_;
  std::int64_t total_;
  std::vector<std::int64_t> ids_;
  std::vector<StoredColumn> columns_;
};

/// Takes this rank's rows of a checkpoint's table: afterwards all rows are owned. Throws CheckpointError if a column is
/// missing.
void restore_particles(const Checkpoint& checkpoint, std::string_view table, ParticleSet& particles);

}  // namespace sphdrop
