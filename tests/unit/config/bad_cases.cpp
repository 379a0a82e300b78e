#include "bad_cases.hpp"

#include <cassert>
#include <stdexcept>

#include "config/case_file.hpp"

namespace sphdrop::testing {

const std::string good_case =
    "name = \"tip_impact\"\n"  // line 1
    "[resolution]\n"           // 2
    "spacing = 2.5e-5\n"       // 3
    "[time]\n"                 // 4
    "end = 5e-3\n"             // 5
    "[drop]\n"                 // 6
    "velocity = [0, -0.8]\n"   // 7
    "[solid]\n"                // 8
    "kind = \"cantilever\"\n"  // 9
    "length = 8e-3\n";         // 10

std::string with(const std::string& from, const std::string& to, std::string text) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good case has no " + from);
  return text.replace(at, from.size(), to);
}

// Line 11 of the good case plus further ones.
std::string plus(const std::string& lines) {
  return good_case + lines;
}

std::vector<std::string> messages_for(const BadCase& bad) {
  try {
    parse_case_text(bad.text, "bad.cfg", bad.overrides);
  } catch (const CaseError& error) {
    return error.mistakes();
  }
  return {};
}

std::vector<BadCase> bad_cases() {
  std::vector<BadCase> all = bad_texts();
  for (BadCase& bad : bad_values()) all.push_back(std::move(bad));
  return all;
}

}  // namespace sphdrop::testing
