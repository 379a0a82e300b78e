#pragma once
// What is inside the library's Case.

#include <string>
#include <vector>

#include "api/sphdrop.hpp"
#include "config/case_file.hpp"

namespace sphdrop::v1 {

struct Case::Content {
  std::string text, source_name;
  std::vector<std::string> overrides;
  sphdrop::ParsedCase parsed;
};

}  // namespace sphdrop::v1
