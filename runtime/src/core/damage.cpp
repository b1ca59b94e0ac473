// SPDX-License-Identifier: MIT
#include "sherd/runtime/damage.h"

#include <algorithm>

#include "sherd/runtime/asset.h"
#include "sherd/runtime/material.h"

namespace sherd {

// An impulse j along the normal takes j v - j^2 / (2 m) out of the relative motion: at j = m v, the
// perfectly plastic impact, all of 1/2 m v^2. A contact that did less cannot have spent more; one
// that bounced did more, but what it gave back was not available to breaking twice.
float contactEnergy(const Contact& contact) {
    if (!(contact.approachSpeed > 0) || !(contact.effectiveMass > 0)) return 0;
    const float plastic = contact.effectiveMass * contact.approachSpeed;
    const float impulse = std::clamp(contact.impulse, 0.0F, plastic);
    return impulse * contact.approachSpeed - impulse * impulse / (2 * contact.effectiveMass);
}

float contactStress(const Asset& asset, uint32_t fragment, float approachSpeed) {
    constexpr float kConcentration = 3;
    const Fragment& struck = asset.fragment(fragment);
    const float wave = 0.5F * struck.density * materialNamed(struck.material).soundSpeed;
    return kConcentration * wave * std::max(approachSpeed, 0.0F);
}

DamageOptions combine(const DamageOptions& world, const DamageOptions& object) {
    DamageOptions both;
    both.toughnessScale = world.toughnessScale * object.toughnessScale;
    both.strengthScale = world.strengthScale * object.strengthScale;
    both.levelScale = world.levelScale * object.levelScale;
    both.minimumImpulse = std::max(world.minimumImpulse, object.minimumImpulse);
    both.minimumEnergy = std::max(world.minimumEnergy, object.minimumEnergy);
    both.immunity = std::max(world.immunity, object.immunity);
    both.maxLevel = std::min(world.maxLevel, object.maxLevel);
    return both;
}

bool isBreakable(const Asset& asset, uint32_t fragment, const DamageOptions& options) {
    const Fragment& piece = asset.fragment(fragment);
    return piece.children.count > 0 && piece.level < options.maxLevel;
}

}  // namespace sherd
