// SPDX-License-Identifier: MIT
#include "sherd/runtime/placement.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "core/finite.h"

namespace sherd {

Result<Placement> placementOf(const glm::mat4& objectToWorld) {
    constexpr float kSame = 1e-3F;
    const auto refuse = [](const char* why) {
        return fail(ErrorCode::badArgument, why, "objectToWorld");
    };
    for (int c = 0; c < 4; ++c)
        if (!isFinite(glm::vec3(objectToWorld[c])) || objectToWorld[c].w != (c == 3 ? 1.0F : 0.0F))
            return refuse("the matrix is not affine and finite");
    const glm::mat3 axes(objectToWorld);
    const glm::vec3 lengths(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
    const float least = std::min({lengths.x, lengths.y, lengths.z});
    const float most = std::max({lengths.x, lengths.y, lengths.z});
    if (!(least > 0) || !std::isfinite(most)) return refuse("the matrix has no size");
    if (most - least > kSame * most)
        return refuse("the matrix scales its axes differently; bake the object at that shape");
    const glm::mat3 turn(axes[0] / lengths.x, axes[1] / lengths.y, axes[2] / lengths.z);
    const float skew =
        std::max({std::abs(glm::dot(turn[0], turn[1])), std::abs(glm::dot(turn[0], turn[2])),
                  std::abs(glm::dot(turn[1], turn[2]))});
    if (skew > kSame) return refuse("the matrix shears; bake the object at that shape");
    if (glm::determinant(turn) < 0)
        return refuse("the matrix mirrors; bake the mirrored object by itself");
    Placement placement;
    placement.pose.translation = glm::vec3(objectToWorld[3]);
    placement.pose.rotation = glm::normalize(glm::quat_cast(turn));
    placement.scale = std::cbrt(lengths.x * lengths.y * lengths.z);
    return placement;
}

}  // namespace sherd
