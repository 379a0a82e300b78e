#pragma once
// Every kind of mistake in a case, and what its author must be told.

#include <string>
#include <vector>

namespace sphdrop::testing {

struct BadCase {
  std::string kind;
  std::string text;                    ///< of the file bad.cfg
  std::vector<std::string> overrides;  ///< --set
  /// For each mistake in order: fragments its message must hold; the first is the start of the message.
  std::vector<std::vector<std::string>> expected;
};

/// A valid case of ten lines, which the bad ones change.
extern const std::string good_case;

std::vector<BadCase> bad_cases();
std::vector<BadCase> bad_texts();   ///< no TOML, unknown names, wrong types
std::vector<BadCase> bad_values();  ///< bad, missing or contradictory values; the command line

/// `text` with `from`, which must be there, replaced.
std::string with(const std::string& from, const std::string& to, std::string text = good_case);
/// The good case and, from line 11 on, further lines.
std::string plus(const std::string& lines);

/// The messages for one, as parse_case_text gives them for the file name bad.cfg; empty if it is accepted.
std::vector<std::string> messages_for(const BadCase& bad);

}  // namespace sphdrop::testing
