// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btTransform.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "sherd/formats/fracture_set.h"

namespace sherd {

inline btVector3 toBullet(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}
inline btQuaternion toBullet(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}
inline btTransform toBullet(const RigidPose& pose) {
    return btTransform(toBullet(pose.rotation).normalized(), toBullet(pose.translation));
}

inline glm::vec3 toGlm(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}
inline RigidPose toPose(const btTransform& t) {
    const btQuaternion q = t.getRotation();
    return {toGlm(t.getOrigin()), glm::quat(q.w(), q.x(), q.y(), q.z())};
}

}  // namespace sherd
