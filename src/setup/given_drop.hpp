#pragma once
// A drop from a file's particles.

#include <string>
#include <vector>

#include "config/case.hpp"
#include "setup/droplet.hpp"

namespace sphdrop {

/// The particles of drop.particles_file about their centre, in the order of the file. Their masses are the file's or,
/// where it has none, equal ones that add up to rho pi D^2/4 with D = drop.diameter. Throws SetupError, with the
/// particle's place in the file: where one is nearer to another than half a spacing, where their distances do not fit
/// the spacing, and for a mass that does not fit it. `input` has one drop.
Drop drop_of_file(const Case& input);

/// What their author should know: that they are in pieces which are farther apart than the kernel reaches; or "".
std::string doubt_of_file(const Case& input);

}  // namespace sphdrop
