#pragma once
// All parameters, for people to read.

#include <string>

namespace sphdrop {

/// A heading, then for each parameter a line that begins with its key and has type, unit and the paper's symbol, and
/// below it, indented, the description, the allowed values and the default; in lines that fit a terminal.
std::string list_parameters_text();

/// The same as Markdown, a table for each section.
std::string parameter_reference_markdown();

}  // namespace sphdrop
