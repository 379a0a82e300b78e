#pragma once
// The solids of a case among the particles, whose ids run from solid to solid.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "particles/solid_particles.hpp"
#include "setup/initial_particles.hpp"

namespace sphdrop {

/// The global ids of one solid of the case.
struct SolidIds {
  std::size_t solid = 0;  ///< its place in the case: 0, 1, ...
  std::int64_t begin = 0, end = 0;

  std::int64_t size() const { return end - begin; }
};

/// All of them, ascending. `first_id`: of the first solid's first particle.
inline std::vector<SolidIds> solid_bodies(const InitialSolid& initial, std::int64_t first_id) {
  std::vector<SolidIds> bodies;
  for (const InitialSolid::Body& body : initial.bodies)
    bodies.push_back({bodies.size(), first_id + body.begin, first_id + body.end});
  if (bodies.empty()) bodies.push_back({0, first_id, first_id + initial.total()});
  return bodies;
}

/// f(row) for the owned rows of one solid; the rows must be sorted by id.
template <class F>
void for_each_owned_of(const SolidParticles& particles, const SolidIds& ids, F&& f) {
  const auto row_of = [&](std::int64_t id) {
    return static_cast<std::int32_t>(std::lower_bound(particles.id.begin(), particles.id.end(), id) -
                                     particles.id.begin());
  };
  const std::int32_t begin = row_of(ids.begin), end = row_of(ids.end);
  for (const RowRange& range : particles.owned)
    for (std::int32_t row = std::max(begin, range.begin); row < std::min(end, range.end); ++row)
      f(static_cast<std::size_t>(row));
}

}  // namespace sphdrop
