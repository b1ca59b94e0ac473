// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "import/gltf_source.h"
#include "sherd/formats/result.h"

namespace sherd {

/// x -> rotation * (deform * x) + translation, with a proper rotation. `deform` holds scale, shear
/// and mirroring, and is exactly the identity where there are none.
struct NodeTransform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dmat3 deform{1.0};
};

/// Parent of every node, -1 for roots. Refuses two parents, cycles and children out of range.
Result<std::vector<int>> nodeParents(const GltfSource& source);

/// From the node's own coordinates to the scene's.
Result<NodeTransform> globalTransform(const GltfSource& source, const std::vector<int>& parents,
                                      int node);

}  // namespace sherd
