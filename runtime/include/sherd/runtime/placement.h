// SPDX-License-Identifier: MIT
#pragma once

#include <glm/mat4x4.hpp>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Where an instance stands, and how large: first the scale, then the pose.
struct Placement {
    RigidPose pose;
    float scale = 1;
};

/// The placement that a level's matrix means. Masses, colliders and bonds have no size in one
/// direction only: a matrix that stretches, shears, mirrors or projects is an error
/// (`badArgument`) that says which. Lengths may differ by 0.1 %.
Result<Placement> placementOf(const glm::mat4& objectToWorld);

}  // namespace sherd
