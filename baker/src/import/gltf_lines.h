// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "import/node_transforms.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

/// By their mode alone, whatever else they lack.
bool hasLines(const GltfSource& source, int mesh);
bool hasTriangles(const GltfSource& source, int mesh);

/// What node `node` models as lines (LINES, LINE_LOOP, LINE_STRIP primitives of its mesh), in scene
/// coordinates. What was dropped is reported.
Result<std::vector<FractureMap::SurfaceLine>> readNodeLines(const GltfSource& source, int node,
                                                            const NodeTransform& toScene,
                                                            std::vector<std::string>& warnings);

}  // namespace sherd
