#pragma once
// Particles as a run starts with them. Positions in m, velocities in m/s, masses in kg per metre of depth.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "particles/column_stretch.hpp"
#include "particles/plane_moments.hpp"
#include "particles/vector.hpp"
#include "rigid_body/mass_properties.hpp"
#include "setup/box.hpp"
#include "setup/share.hpp"

namespace sphdrop {

/// The drop's particles, or those of a share of their ids. Shapes: [particles of the share].
struct InitialFluid {
  std::vector<Vector> positions, velocities;
  std::vector<double> masses;
  std::int64_t first_id = 0;  ///< of the particles here

  // Of the whole drop, on every process.
  std::int64_t total = 0;  ///< number of particles
  Vector centre;           ///< of the drop
  Box bounds;              ///< the smallest that holds all particles
  double rest_area = 0;    ///< the sum of mass over fluid.density by ascending id, m2
  MassProperties as_body;  ///< of a rigid drop

  IdRange ids() const { return {first_id, first_id + static_cast<std::int64_t>(positions.size())}; }
};

/// A corner of the contact surface, which moves with the mean of some particles and hands its force on to them by the
/// same weights, so that force and moment are kept.
struct ContactVertex {
  std::int32_t count = 0;                  ///< of particles
  std::array<std::int32_t, 4> particle{};  ///< of different ones
  std::array<double, 4> weight{};          ///< they add up to 1

  static ContactVertex at_particle(std::int32_t k) { return {1, {k}, {1.0}}; }
};

/// A particle that a support keeps from moving in some directions.
struct Hold {
  std::int32_t particle = 0;
  bool in_x = false, in_y = false;
};

/// The solid's particles, or those of a share of them. Shapes: [particles of the share]. A beam's particles stand in
/// lattice order: column by column in x, from bottom to top in a column. All indices count the whole solid's.
struct InitialSolid {
  std::vector<Vector> positions, velocities;
  std::vector<double> masses;
  std::vector<char> is_fixed;  ///< 1: a particle of a clamp or wall, which never moves

  // Of the particles that are left to other shares; where there are none, these may be left as they are.
  std::int64_t before = 0, after = 0;                ///< how many come before and after these
  Box bounds;                                        ///< holds them all, and these
  std::vector<std::vector<Vector>> polyline_places;  ///< of the contact polylines' vertices, m

  std::int64_t total() const { return before + static_cast<std::int64_t>(positions.size()) + after; }
  IdRange indices() const { return {before, before + static_cast<std::int64_t>(positions.size())}; }

  /// The boundary as indices of contact_vertices, the solid on the right when walking along.
  std::vector<std::vector<std::int32_t>> contact_polylines;
  std::vector<ContactVertex> contact_vertices;  ///< empty: vertex k is particle k
  /// The parts of the body that belong to a particle, to the south-west, south-east, north-west and north-east of it,
  /// in spacings about it; empty: a quarter of a square of side 1 each.
  std::vector<std::array<PlaneMoments, 4>> quadrants;
  /// The lattice of a straight beam that is alone, other shares' particles with it; else empty.
  std::vector<ColumnStretch> columns;
  std::vector<Hold> holds;
  std::vector<Vector> outline;  ///< m; of a polygon or an obstacle

  /// One of several solids: its particles and probes.
  struct Body {
    std::int32_t begin = 0, end = 0;
    std::vector<std::int32_t> deflection_probe, middle_probe;
  };
  std::vector<Body> bodies;  ///< empty: one of all particles
  /// The particles whose mean displacement is the deflection delta(t); ascending.
  std::vector<std::int32_t> deflection_probe;
  /// Those of mid-span, ascending; the same as deflection_probe for a beam fixed at both ends.
  std::vector<std::int32_t> middle_probe;
  std::size_t mobile_count = 0;  ///< of all
  double top = 0;                ///< y of the surface a drop falls on, m
};

}  // namespace sphdrop
