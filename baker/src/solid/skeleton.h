// SPDX-License-Identifier: MIT
// Where three or more pieces meet inside the solid: the lines that lead inwards from the nodes of
// the border graph.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "solid/border_graph.h"

namespace sherd {

/// A node is led to its partner on the far side, around which the same pieces lie the other way
/// round; or to a hub inside, which it shares with other nodes.
struct Skeleton {
    std::vector<uint32_t> partner;  ///< per node: another node; kNone
    std::vector<uint32_t> hubOf;    ///< per node; kNone
    std::vector<glm::vec3> hubs;
};

/// How nodes that have no partner share hubs.
enum class HubChoice : uint8_t {
    near,   ///< partners first; of the rest, few near ones that close around a point
    centre  ///< one hub for all nodes of a connected border
};

Skeleton findSkeleton(std::span<const glm::vec3> positions, const BorderGraph& graph,
                      HubChoice choice);

}  // namespace sherd
