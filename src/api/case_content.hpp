#pragma once
// What is inside the library's Case.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "api/sphdrop.hpp"
#include "config/case_file.hpp"

namespace sphdrop::v1 {

/// Files of particles that have been read.
using ParticlesByPath = std::map<std::string, std::shared_ptr<const GivenParticles>>;

struct Case::Content {
  std::string text, source_name;
  std::vector<std::string> overrides;
  ParticlesByPath particles;
  sphdrop::ParsedCase parsed;

  /// `particles`: those that need not be read again.
  static std::shared_ptr<const Content> make(const std::string& text, const std::string& source_name,
                                             const std::vector<std::string>& overrides, ParticlesByPath particles,
                                             const ParticleReader& read);
};

}  // namespace sphdrop::v1
