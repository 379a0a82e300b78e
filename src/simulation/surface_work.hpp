#pragma once
// What the surface costs the rank that works on it.

#include <cmath>
#include <cstddef>
#include <numbers>

#include "config/case.hpp"

namespace sphdrop {

/// In a step, in particles of the liquid; 0 where there is no surface, or where the contact's owner is its owner too,
/// as it is where the solid attracts the liquid. A point of the curve takes as long as a particle, with what it takes
/// to bring its band together and back (tests/benchmarks/README.md). `particles`: of a drop, whose outline counts as
/// round.
inline double surface_work(const Case& input, std::size_t particles) {
  const bool has_owner = input.drop.is_liquid() && input.surface_tension.form != SurfaceTensionForm::none &&
                         input.surface_tension.coefficient > 0 && !input.is_wetting();
  constexpr double particles_a_point = 1.0;
  return has_owner ? particles_a_point * 2.0 * std::sqrt(std::numbers::pi * static_cast<double>(particles)) : 0.0;
}

}  // namespace sphdrop
