#pragma once
// One file read for all ranks.

#include <string>

#include "decomposition/communicator.hpp"

namespace sphdrop {

/// Collective. The text of a case file, which rank 0 alone reads. Throws CaseError on all ranks.
std::string shared_case_text(const Communicator& communicator, const std::string& path);

}  // namespace sphdrop
