// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "import/node_recipes.h"
#include "sherd/baker/import.h"

namespace sherd {

/// The chosen mesh nodes of a document. `name`: the file, for errors. Nodes of different recipes
/// are different objects, even if they show the same mesh.
Result<std::vector<SurfaceMesh>> importGltf(const GltfDocument& document, const std::string& name,
                                            const ImportOptions& options,
                                            const NodeRecipes& recipes = {});

}  // namespace sherd
