// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace sherd {

/// Of a solid of unit density (kg/m^3): multiply volume and inertia by the density.
struct MassProperties {
    double volume = 0;        ///< m^3; negative if the surface is inside out
    glm::dvec3 center{0.0};   ///< centre of mass
    glm::dmat3 inertia{0.0};  ///< m^5, about the centre of mass
};

/// Exact for the polyhedron a closed, outward-oriented triangle mesh bounds.
MassProperties massProperties(std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles);

/// The body made of all parts together.
/// Whether some body has this mass: volume and moments positive, no moment above the sum of the
/// others.
bool isPhysical(const MassProperties& mass);

MassProperties combine(std::span<const MassProperties> parts);

struct PrincipalAxes {
    glm::dvec3 diagonal{0.0};
    glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};  ///< from principal axes to the tensor's frame
};

/// Of a symmetric tensor: rotation * diag * rotation^T. A diagonal tensor keeps its axes; others
/// are turned as little as the method needs, so equal input gives equal axes, right-handed.
PrincipalAxes principalAxes(const glm::dmat3& tensor);

}  // namespace sherd
