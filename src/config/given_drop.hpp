#pragma once
// A drop whose particles stand in a file (drop.particles_file): how the case comes by them, and what follows.

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "config/case.hpp"

namespace sphdrop {

/// A file of particles that cannot be used. Thrown by a ParticleReader on all processes that parse the case together.
struct ParticleFileError : std::runtime_error {
  /// `is_located`: the text begins with the place in that file, and the case is only where it is named.
  ParticleFileError(const std::string& text, bool located) : std::runtime_error(text), is_located(located) {}
  bool is_located;
};

struct ParticleRequest {
  std::string path;               ///< of the file: beside the case file unless the case names an absolute path
  std::string results_directory;  ///< as the case has it
  std::size_t drop = 0;           ///< 0, 1, ...
};

/// Reads such a file.
using ParticleReader = std::function<std::shared_ptr<const GivenParticles>(const ParticleRequest&)>;

/// Where the file lies that a case names.
std::string particle_file_path(const std::string& named, const std::string& case_file);

/// Whether the case gives this parameter of the drop.
using IsGiven = std::function<bool(std::string_view key)>;

/// A drop with a file has the shape "particles" unless the case gives another, which consistency.cpp refuses.
void take_shape(Case::Drop& drop, const IsGiven& is_given);

/// Takes the particles into the case's drop, and with them what the case does not give: the checksum, the diameter of
/// the circle of their area (of their mass, where the file has masses; spacing^2 each, where not), and, where nothing
/// places the drop, the place they have. Returns what is wrong, beginning with the key that is, or "".
std::string take_given_particles(Case& one, const IsGiven& is_given, std::shared_ptr<const GivenParticles> particles);

}  // namespace sphdrop
