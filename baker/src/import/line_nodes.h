// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>
#include <vector>

#include "import/gltf_source.h"

namespace sherd {

/// Nodes whose mesh holds lines and no triangles, and the object each belongs to: the nearest node
/// above it that has triangles.
struct LineNodes {
    std::unordered_map<int, std::vector<int>> below;  ///< object node -> its line nodes, ascending
    std::vector<int> stray;                           ///< below no object; ascending
};

/// `shown`: the nodes among which stray ones count. `parents` as nodeParents gives them.
LineNodes findLineNodes(const GltfSource& source, const std::vector<int>& parents,
                        const std::vector<int>& shown);

}  // namespace sherd
