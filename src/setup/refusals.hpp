#pragma once
// What cannot be set up. All throw SetupError. Whole drops are walked through, a little of them is kept at a time, so
// that the same is said on every process, whichever particles it will have.

#include <vector>

#include "config/case.hpp"
#include "particles/vector.hpp"
#include "setup/initial_particles.hpp"
#include "setup/placed_drop.hpp"

namespace sphdrop {

/// For more than 1e8 particles.
void refuse_too_many_particles(const Case& input);

/// Where particles of different drops are nearer than most of a `spacing` (m): the pressure between them would fling
/// them apart.
void refuse_overlapping_drops(const std::vector<PlacedDrop>& drops, double spacing);

/// Where a drop is nearer to the solid than the contact distance, by the contact algorithm itself, so that what passes
/// here is at rest there. `centre`: of the first drop, m, for the message.
void refuse_overlap(const Case& input, const std::vector<PlacedDrop>& drops, const InitialSolid& solid, Vector centre);

}  // namespace sphdrop
