// SPDX-License-Identifier: MIT
// Surfaces turned around the y axis, closed by a pole at each end, unwrapped into strips and discs.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "mesh.h"

namespace sherd::samples {

/// A place on the profile: distance from the axis and height, metres.
struct ProfilePoint {
    double radius = 0;
    double height = 0;
};

/// A piece of the unwrapping: the rings `first` to `last`.
struct LatheChart {
    enum class Kind {
        strip,  ///< angle runs along u, the way along the profile along v
        disc,   ///< seen along the axis
    };
    Kind kind = Kind::strip;
    uint32_t first = 0;
    uint32_t last = 0;
    glm::dvec2 uvFirst{0.0};  ///< strip: UV at ring `first`, angle 0; disc: UV of the axis
    glm::dvec2 uvLast{
        0.0};  ///< strip: UV at ring `last`, angle 2 pi; disc: UV per metre in x and z
};

/// From the bottom pole outwards, up, and on to the other pole. Both poles have radius 0.
struct Lathe {
    std::vector<ProfilePoint> profile;
    std::vector<LatheChart> charts;  ///< together they cover all rings, neighbours share one
    uint32_t segments = 64;
    /// Radius of ring `ring` at `angle`; unset: ProfilePoint::radius all around.
    std::function<double(uint32_t ring, double angle)> radius;
};

Mesh turn(const Lathe& lathe);

/// A smooth curve through the points (Catmull-Rom), `steps` pieces between each two.
std::vector<ProfilePoint> smoothProfile(std::span<const ProfilePoint> points, uint32_t steps);

}  // namespace sherd::samples
