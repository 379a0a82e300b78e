#pragma once
// Particles' quantities by the names that snapshots give them.

#include <cstdint>
#include <string>
#include <vector>

#include "api/sphdrop.hpp"
#include "particles/particle_set.hpp"

namespace sphdrop {

/// Of all that has the role `written`.
std::vector<v1::Quantity> written_columns(const ParticleSet& particles);

/// Of the particles owned here. Throws v1::Error if there is no such written column.
std::vector<double> owned_values(const ParticleSet& particles, const std::string& name);
std::vector<std::int64_t> owned_ids(const ParticleSet& particles);

}  // namespace sphdrop
