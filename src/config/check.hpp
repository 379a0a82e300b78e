#pragma once
// What contradictions and doubts have in common: a list of questions to a case.

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/case.hpp"
#include "config/consistency.hpp"

namespace sphdrop {

/// What is wrong, or nothing.
using Verdict = std::optional<std::string>;

struct Check {
  std::vector<std::string_view> keys;  ///< as in Finding
  Verdict (*judge)(const Case&);
};

inline std::vector<Finding> run_checks(const std::vector<Check>& checks, const Case& values,
                                       const IsUsable& is_usable) {
  std::vector<Finding> findings;
  for (const Check& check : checks) {
    if (!std::all_of(check.keys.begin(), check.keys.end(), is_usable)) continue;
    if (Verdict verdict = check.judge(values)) findings.push_back({check.keys, std::move(*verdict)});
  }
  return findings;
}

/// About how many the case makes.
double particle_count(const Case& values);

/// Rows of particles across the beam, not rounded.
inline double rows_across(const Case& values) {
  return values.solid.thickness / values.resolution.spacing;
}

}  // namespace sphdrop
