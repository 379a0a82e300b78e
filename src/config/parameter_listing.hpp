#pragma once
// All parameters, for people to read.

#include <string>

namespace sphdrop {

/// Aligned columns: key, type, unit, default, allowed values, the paper's symbol, description.
std::string list_parameters_text();

/// The same as Markdown, a table for each section.
std::string parameter_reference_markdown();

}  // namespace sphdrop
