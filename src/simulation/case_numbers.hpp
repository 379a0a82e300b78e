#pragma once
// What a case is, in the numbers of the field.

#include <string>

#include "simulation/simulation.hpp"

namespace sphdrop {

/// Lines of "label value": the drop's dimensionless numbers, what it will do on a rigid wall, how finely it and the
/// beam are resolved, and what theory expects of the beam. Looks at the case and what follows from it alone.
std::string case_numbers_text(const Simulation& simulation);

}  // namespace sphdrop
