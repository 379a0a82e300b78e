#pragma once
// Files of a drop's particles: what their columns mean, one rank that reads them for all, and the copies that results
// keep.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "config/given_drop.hpp"
#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Reads a file of particles by this process alone (io/FORMAT.md). `file` stands in messages. Throws ParticleFileError.
std::shared_ptr<const GivenParticles> read_particle_file(const std::string& path, const std::string& file);

/// Where copies of files may lie that are not there any more, in the order in which they are looked for.
using CopyFolders = std::vector<std::filesystem::path>;

/// Collective: rank 0 reads and all get the same. Throws ParticleFileError on all ranks. Of a file that is not there
/// rank 0 takes the copy in the first of `folders` that has one, and says so.
std::shared_ptr<const GivenParticles> shared_particles(const Communicator& communicator, const ParticleRequest& request,
                                                       const CopyFolders& folders);

/// The case as case.cfg beside the results has it: with the names of the copies there instead of the files.
Case with_copies(const Case& input);

/// Collective. Writes the copies. Throws OutputDirectoryError.
void write_copies(const Communicator& communicator, const std::filesystem::path& directory, const Case& input);

}  // namespace sphdrop
