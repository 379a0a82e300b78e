#pragma once
// Which part of the liquid's surface a rank works on, and what other ranks need of it for theirs.

#include <cstdint>
#include <span>
#include <vector>

#include "decomposition/exchange_plan.hpp"
#include "particles/fluid_particles.hpp"
#include "simulation/distribution.hpp"
#include "surface_tension/surface_curve.hpp"

namespace sphdrop {

/// How far things along the surface matter to each other, m.
struct SurfaceRange {
  double action = 0;     ///< between a surface point and the particles it may act on, as they were at detection
  double looseness = 0;  ///< how much nearer to each other two particles may have been when they were distributed
};

/// A force on a surface point needs the curve that many nodes to both sides: its own normal and its neighbours', and of
/// a polynomial through five points those of the next ones.
inline constexpr int steps_of_a_force = 3;

/// A rank works on all points that may act on its particles, and on the neighbours along the curve of its own nodes, so
/// that nothing has to come back from others. Each works on few points that others work on too.
struct SurfaceShare {
  std::vector<std::int32_t> rows;  ///< own rows that may feel the surface
  std::vector<char> is_wanted;     ///< by node: whether its point is worked on here
  std::vector<RankRows> sends;     ///< of `rows`, what others need, by ascending rank
};

/// Each rank for itself. `points`: by node, as of detection, m. `whole_at`: a rank that works on the whole surface, or
/// -1.
SurfaceShare share_of_surface(const Communicator& communicator, const FluidParticles& fluid,
                              const Distribution& distribution, const SurfaceCurves& curves,
                              std::span<const Vector> points, const SurfaceRange& range, int whole_at);

}  // namespace sphdrop
