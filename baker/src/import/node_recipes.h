// SPDX-License-Identifier: MIT
// Recipes that a glTF scene carries on its nodes.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "import/gltf_source.h"
#include "sherd/baker/import.h"

namespace sherd {

/// `extras.sherd` of mesh nodes, or of their meshes; the node's own wins. Nodes that carry the same
/// recipe share one.
struct NodeRecipes {
    std::vector<Recipe> recipes;
    std::map<int, int32_t> ofNode;      ///< node -> into recipes
    std::vector<std::string> warnings;  ///< recipes on nodes without a mesh
    std::optional<double> unitScale;    ///< that the recipes agree on

    /// Of a node, -1 without one.
    int32_t of(int node) const;
};

/// Of the nodes that the options choose. Errors: those of a recipe; invalidData where recipes of
/// one scene, or of the nodes to join, contradict each other.
Result<NodeRecipes> readNodeRecipes(const GltfDocument& document, const std::filesystem::path& path,
                                    const ImportOptions& options);

/// How many nodes and meshes carry one.
size_t countNodeRecipes(const GltfDocument& document);

}  // namespace sherd
