// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
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

/// From a node's own coordinates to the scene's, each node worked out once.
class GlobalTransforms {
  public:
    /// Both outlive this.
    GlobalTransforms(const GltfSource& source, const std::vector<int>& parents)
        : source_(source), parents_(parents), known_(parents.size()) {}

    Result<NodeTransform> of(int node);

  private:
    const GltfSource& source_;
    const std::vector<int>& parents_;
    std::vector<std::optional<NodeTransform>> known_;
};

/// `of` seen from the rigid frame of `frame`, as linear * x + offset. With equal rotations nothing
/// is rotated, so that bit-equal vertices stay so.
struct Placement {
    glm::dmat3 linear{1.0};
    glm::dvec3 offset{0.0};
};
Placement relativeTo(const NodeTransform& frame, const NodeTransform& of);

}  // namespace sherd
