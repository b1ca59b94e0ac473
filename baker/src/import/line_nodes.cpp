// SPDX-License-Identifier: MIT
#include "import/line_nodes.h"

#include "import/gltf_lines.h"

namespace sherd {
namespace {

/// Per node: the nearest node above it that has triangles, -1 if there is none.
std::vector<int> objectsAbove(const GltfSource& source, const std::vector<int>& parents) {
    const auto& nodes = source.model.nodes;
    std::vector<int> above(nodes.size(), -1);
    std::vector<int> reached;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (parents[i] == -1) reached.push_back(static_cast<int>(i));
    }
    for (size_t i = 0; i < reached.size(); ++i) {
        const int node = reached[i];
        const tinygltf::Node& parent = nodes[static_cast<size_t>(node)];
        const int object =
            hasTriangles(source, parent.mesh) ? node : above[static_cast<size_t>(node)];
        for (const int child : parent.children) {
            above[static_cast<size_t>(child)] = object;
            reached.push_back(child);
        }
    }
    return above;
}

}  // namespace

LineNodes findLineNodes(const GltfSource& source, const std::vector<int>& parents,
                        const std::vector<int>& shown) {
    const auto isLineNode = [&](int node) {
        const int mesh = source.model.nodes[static_cast<size_t>(node)].mesh;
        return hasLines(source, mesh) && !hasTriangles(source, mesh);
    };
    const std::vector<int> above = objectsAbove(source, parents);
    LineNodes out;
    for (int node = 0; node < static_cast<int>(above.size()); ++node) {
        const int object = above[static_cast<size_t>(node)];
        if (object >= 0 && isLineNode(node)) out.below[object].push_back(node);
    }
    for (const int node : shown) {
        if (above[static_cast<size_t>(node)] < 0 && isLineNode(node)) out.stray.push_back(node);
    }
    return out;
}

}  // namespace sherd
