// SPDX-License-Identifier: MIT
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "sherd/formats/fracture_set.h"
#include "sherd/runtime/damage.h"

namespace sherd {

/// Energy let loose on a region by the game itself: a drill, a blade, a blast, a scripted crack. In
/// whatever frame the function that takes it says.
struct AreaDamage {
    enum class Shape {
        sphere,   ///< around `a`
        capsule,  ///< around the way from `a` to `b`: a ray, a bullet's path
        box,      ///< around `a`, half as wide as `b` along the axes of `rotation`; of no radius
    };
    Shape shape = Shape::sphere;
    glm::vec3 a{0.0F}, b{0.0F};                  ///< metres
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit
    float radius = 0;                            ///< metres, > 0 but of a box
    /// Energy per area of bond, J/m^2, in the core. A bond breaks that gets its toughness x
    /// dissipation; infinity breaks whatever is inside.
    float fluence = 0;
    /// Share of the radius over which the fluence falls evenly to nothing, 0..1; 0: none of it.
    float falloff = 1;
    /// Unit: bonds feel only the share of a motion in this direction that shears them; zero: all
    /// feel everything.
    glm::vec3 shear{0.0F};
};

/// An error's text, or nullptr when the damage can be dealt.
const char* whyRefused(const AreaDamage& damage);

/// The same damage seen from another frame, which `frame` places in the one it is given in.
AreaDamage seenFrom(const RigidPose& frame, const AreaDamage& damage);

/// Deals damage, in the object's frame, to the bonds and anchors of some standing fragments (an
/// island) whose centroid the region holds, of every level. Fragments open that have a broken bond
/// within.
void applyArea(Structure& structure, std::span<const uint32_t> fragments, const AreaDamage& damage,
               const DamageOptions& options, HitResult& result);

/// Gives all bonds `share` of their energy back, 0..1. Broken ones stay broken: what they held has
/// moved.
void heal(Structure& structure, float share);

}  // namespace sherd
