#pragma once
// Solids side by side.

#include <vector>

#include "config/case.hpp"
#include "setup/droplet.hpp"
#include "setup/initial_particles.hpp"

namespace sphdrop {

/// Moves the body by `shift`, m.
void move_body(InitialSolid& body, Vector shift);

/// All of them as one, in their order, with InitialSolid::bodies; none of them a share. One alone stays as it is.
InitialSolid joined_solids(const std::vector<InitialSolid>& solids);

/// Throws SetupError where particles of two bodies are nearer than `distance`, m.
void refuse_near_solids(const InitialSolid& all, double distance);

/// y (m) for the centre of a drop above x = `centre_x`, so that the nearest of its particles is `gap` + `radius` off
/// the solids: of one solid with straight sides off its top, whatever is below; else as low as it gets from above the
/// highest place below it. Throws SetupError where no solid is below it.
double height_above_solids(const std::vector<InitialSolid>& solids, const Drop& drop, double centre_x, double gap,
                           double radius);

}  // namespace sphdrop
