#pragma once
// Supports that hold single particles of the solid in some directions.

#include <vector>

#include "particles/solid_particles.hpp"
#include "setup/initial_particles.hpp"
#include "simulation/solid_bodies.hpp"

namespace sphdrop {

class PointSupports {
 public:
  PointSupports() = default;
  /// `first_id`: of the solid's first particle.
  PointSupports(const InitialSolid& initial, std::int64_t first_id) : holds_(initial.holds), first_id_(first_id) {}

  /// After every change of the rows.
  void relist(const SolidParticles& solid) {
    rows_.clear();
    for (const Hold& hold : holds_) {
      const std::int64_t id = first_id_ + hold.particle;
      for_each_owned_of(solid, {0, id, id + 1}, [&](std::size_t row) { rows_.push_back({row, hold.in_x, hold.in_y}); });
    }
  }

  /// What starts at rest and is never accelerated stays where it is, and the support does no work on it. An impulse
  /// that was given to its velocity goes to the support.
  void stop(SolidParticles& solid) const {
    for (const HeldRow& held : rows_) {
      if (held.in_x) solid.acceleration.x[held.row] = solid.staggered_velocity.x[held.row] = 0.0;
      if (held.in_y) solid.acceleration.y[held.row] = solid.staggered_velocity.y[held.row] = 0.0;
    }
  }

 private:
  struct HeldRow {
    std::size_t row;
    bool in_x, in_y;
  };
  std::vector<Hold> holds_;
  std::int64_t first_id_ = 0;
  std::vector<HeldRow> rows_;  // owned here
};

}  // namespace sphdrop
