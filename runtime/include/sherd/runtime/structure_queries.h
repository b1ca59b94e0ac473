// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sherd/runtime/structure.h"

namespace sherd {

/// What a standing fragment holds on to.
struct Neighbor {
    uint32_t fragment = 0;  ///< BondGraph::kWorld: its anchors
    float area = 0;         ///< of the bonds between the two that are not broken, m^2
    float health = 0;       ///< what is left of all bonds between them, by area, 0..1
};

/// Ascending, the world last; none of a fragment that does not stand.
void findNeighbors(const Structure& structure, uint32_t fragment, std::vector<Neighbor>& neighbors);

/// What is left of all bonds of a fragment, within it and around it, by area: 1 sound, 0 all
/// broken. 1 when it has none.
float healthOf(const Structure& structure, uint32_t fragment);

}  // namespace sherd
