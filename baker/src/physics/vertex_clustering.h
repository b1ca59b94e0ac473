// SPDX-License-Identifier: MIT
#pragma once

#include "physics/solid_chain.h"

namespace sherd {

/// A coarser solid: of all vertices in a cell of a grid one is left. `cells` along its longest
/// side.
SolidChain clusterVertices(const SolidChain& solid, uint32_t cells);

/// How often the skin winds around a point that does not lie on it.
double windingNumber(const SolidChain& solid, const glm::dvec3& point);

}  // namespace sherd
