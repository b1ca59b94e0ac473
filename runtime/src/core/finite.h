// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "sherd/formats/fracture_set.h"

namespace sherd {

inline bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool isUnit(const glm::quat& q) {
    return std::abs(glm::dot(q, q) - 1) < 1e-3F;
}

inline bool isSound(const RigidPose& pose) {
    return isFinite(pose.translation) && isUnit(pose.rotation);
}

}  // namespace sherd
