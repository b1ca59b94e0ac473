// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "physics/solid_chain.h"

namespace sherd {

/// Planes worth trying to cut a concave solid by: along the faces farthest below its hull, and
/// across its principal axes, there and in the middle; across the longest last.
std::vector<HalfSpace> cutCandidates(const SolidChain& solid, const Polytope& hull);

}  // namespace sherd
