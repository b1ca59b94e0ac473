// SPDX-License-Identifier: MIT
#include "sherd/baker/surface_mesh.h"

namespace sherd {

glm::dvec3 toObjectFrame(const RigidPose& restPose, const glm::dvec3& scene) {
    return glm::inverse(glm::dquat(restPose.rotation)) * (scene - glm::dvec3(restPose.translation));
}

const Attribute* findAttribute(const std::vector<Attribute>& attributes,
                               const std::string& semantic) {
    for (const Attribute& attribute : attributes) {
        if (attribute.semantic == semantic) return &attribute;
    }
    return nullptr;
}

}  // namespace sherd
