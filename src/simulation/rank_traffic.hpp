#pragma once
// What ranks exchange in a step and now and then, for the report.

#include <cstdint>
#include <vector>

#include "diagnostics/summary.hpp"
#include "simulation/simulation.hpp"

namespace sphdrop {

/// Collective. What has been counted in `steps` steps, and in the detections and redistributions among them: of what
/// happened at all.
std::vector<RankTraffic> traffic_of_ranks(const Simulation& simulation, std::int64_t steps);

}  // namespace sphdrop
