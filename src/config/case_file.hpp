#pragma once
// From a case file (TOML) to a validated Case. parameter_table.cpp says what a case may hold.

#include <string>
#include <string_view>
#include <vector>

#include "config/case.hpp"
#include "config/case_error.hpp"
#include "config/given_drop.hpp"

namespace sphdrop {

struct ParsedCase {
  Case values;
  std::vector<std::string> warnings;  ///< "file:line: message": what will run, but not as its author may expect
};

/// Reads a case.
/// source_name: the file's path, for messages and for the default of `name`.
/// overrides: "key=value" each, value in TOML syntax or a bare word; they replace what the text says, the last one
/// wins. Throws CaseError with all the mistakes found. Needs no locale and reads no file: any process that has the text
/// gets the same bits. Files of particles that the case names are asked of `read_particles`, once a drop; without it
/// they are left alone, and the case cannot be set up.
ParsedCase parse_case_text(std::string_view text, const std::string& source_name,
                           const std::vector<std::string>& overrides = {}, const ParticleReader& read_particles = {});

/// parse_case_text(read_text_file(path), path, overrides).
ParsedCase read_case_file(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace sphdrop
