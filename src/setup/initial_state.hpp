#pragma once
// From a case to its particles. Runs alike on every process and gives the same bits on every machine.

#include <string>
#include <vector>

#include "config/case.hpp"
#include "particles/vector.hpp"
#include "setup/initial_particles.hpp"
#include "setup/share.hpp"

namespace sphdrop {

struct InitialState {
  InitialFluid fluid;
  InitialSolid solid;
  Vector drop_centre;                 ///< m; NaN without a drop
  std::vector<std::string> warnings;  ///< what will run, but perhaps not as intended
};

/// The case's drop and solid. A drop that is to come to rest before t = 0 is at rest. Its lowest particle is d/2 + gap
/// above the solid's surface; without a solid the drop is centred at the origin or, in x, where the case says. Where
/// the case leaves the drop's x open (NaN), it is L
/// - D0/2 over a cantilever, L/2 over a beam fixed at both ends, 0 otherwise. Throws SetupError for a drop nearer to
/// the solid than the contact distance (beyond rounding, 1e-6 d), which Eq 24 would shoot away, for more than 1e8
/// particles, and for what build_beam() refuses; the same whatever the share.
///
/// Of the particles those of `share` are kept and the others never stored, except that a drop from a file is read
/// whole, and that a solid is whole unless it is one straight beam, without supports or probes of its own.
InitialState build_initial_state(const Case& input, Share share = {});

}  // namespace sphdrop
