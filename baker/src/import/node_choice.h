// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "import/gltf_source.h"
#include "sherd/baker/import.h"

namespace sherd {

/// Nodes of the default scene, or of scene 0, or all when there are no scenes; ascending.
Result<std::vector<int>> nodesOfScene(const GltfSource& source, const std::vector<int>& parents);

/// The nodes with a mesh that the options name; without any, those of the scene. Each once, never
/// none.
Result<std::vector<int>> chooseNodes(const GltfSource& source, const std::vector<int>& parents,
                                     const ImportOptions& options);

/// For messages: `0 "vase", 3 "lid"`.
std::string listMeshNodes(const GltfSource& source);

/// For messages: `node "vase"`, or `node 3` without a name.
std::string labelOfNode(const GltfSource& source, int node);

}  // namespace sherd
