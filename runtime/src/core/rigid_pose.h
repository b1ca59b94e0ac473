// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// First `b`, then `a`.
inline RigidPose operator*(const RigidPose& a, const RigidPose& b) {
    return {a.translation + a.rotation * b.translation, glm::normalize(a.rotation * b.rotation)};
}

inline RigidPose inverse(const RigidPose& pose) {
    const glm::quat back = glm::conjugate(pose.rotation);
    return {back * -pose.translation, back};
}

inline glm::vec3 operator*(const RigidPose& pose, const glm::vec3& point) {
    return pose.translation + pose.rotation * point;
}

}  // namespace sherd
