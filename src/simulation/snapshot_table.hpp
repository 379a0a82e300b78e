#pragma once
// What a snapshot holds: the written quantities of both materials in one table.

#include <string>
#include <vector>

#include "io/snapshot.hpp"
#include "particles/fluid_particles.hpp"
#include "particles/solid_particles.hpp"

namespace sphdrop {

/// This rank's owned particles, liquid first, with every quantity that has the role `written` in either material, and
/// the column `material`. A quantity that one of the materials does not have is 0 there.
class SnapshotTable {
 public:
  SnapshotTable(const FluidParticles& fluid, const SolidParticles& solid);

  /// Both refer to this table. `total`: particles on all ranks.
  SnapshotRows rows(std::int64_t total) const;
  std::vector<SnapshotColumn> columns() const;

 private:
  struct Quantity {
    std::string name, unit, description;
    std::vector<std::vector<double>> components;
  };
  std::vector<std::int64_t> ids_, material_;
  std::vector<double> x_, y_;
  std::vector<Quantity> quantities_;
};

}  // namespace sphdrop
