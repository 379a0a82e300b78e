#pragma once
// The case as it ran.

#include <string>

#include "config/case.hpp"

namespace sphdrop {

/// A complete case file: every parameter at its value, shortest decimals that read back as the same bits, unit, symbol
/// and meaning as comments. parse_case_text of it gives an identical Case.
std::string effective_case_text(const Case& values);

}  // namespace sphdrop
