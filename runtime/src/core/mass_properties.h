// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "sherd/formats/fracture_set.h"
#include "sherd/runtime/mass_moments.h"

namespace sherd {

/// In double precision and along the object's axes, so that parts can be summed.
struct MassProperties {
    double mass = 0;          ///< kg
    glm::dvec3 center{0.0};   ///< of mass, metres
    glm::dmat3 inertia{0.0};  ///< about the centre, kg m^2
};

struct PrincipalInertia {
    glm::vec3 diagonal{0.0F};                       ///< kg m^2, all > 0 when the mass is
    glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};  ///< of the principal axes
};

MassProperties massOf(const Fragment& fragment);

/// Both as one rigid body (parallel axis theorem).
MassProperties operator+(const MassProperties& a, const MassProperties& b);

/// About a point, metres, and back.
MassMoments momentsAbout(const glm::dvec3& point, const MassProperties& mass);
MassProperties propertiesOf(const MassMoments& moments, const glm::dvec3& point);

PrincipalInertia principalInertia(const MassProperties& mass);

}  // namespace sherd
