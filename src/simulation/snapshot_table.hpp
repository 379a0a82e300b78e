#pragma once
// What a snapshot holds: the written quantities of both materials in one table.

#include <string>
#include <vector>

#include "io/snapshot.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"

namespace sphdrop {

/// This rank's owned particles, liquid first, with every quantity that has the role `written` in either material, and
/// the column `material`, where they lie: to be used before the particles move. A quantity that one of the materials
/// does not have is 0 there.
class SnapshotTable {
 public:
  SnapshotTable(const FluidParticles& fluid, const SolidParticles& solid);

  /// `total`: particles on all ranks.
  SnapshotRows rows(std::int64_t total) const;
  std::vector<SnapshotColumn> columns() const;

 private:
  struct Quantity {
    std::string name, unit, description;
    std::vector<Pieces<double>> components;
  };
  Pieces<std::int64_t> ids_, material_;
  Pieces<double> x_, y_;
  std::vector<Quantity> quantities_;
};

}  // namespace sphdrop
