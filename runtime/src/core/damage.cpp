// SPDX-License-Identifier: MIT
#include "sherd/runtime/damage.h"

#include <algorithm>
#include <limits>

#include "sherd/runtime/asset.h"

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

DamageOptions combine(const DamageOptions& world, const DamageOptions& object) {
    return {world.toughnessScale * object.toughnessScale,
            std::max(world.minimumImpulse, object.minimumImpulse),
            std::max(world.minimumEnergy, object.minimumEnergy),
            std::min(world.maxLevel, object.maxLevel)};
}

float breakThreshold(const Asset& asset, uint32_t fragment, const DamageOptions& options) {
    const Fragment& piece = asset.fragment(fragment);
    if (piece.children.count == 0 || piece.level >= options.maxLevel) {
        return std::numeric_limits<float>::infinity();
    }
    return std::max(options.minimumEnergy, asset.breakEnergy(fragment) * options.toughnessScale);
}

bool breaks(const Asset& asset, uint32_t fragment, float energy, float impulse,
            const DamageOptions& options) {
    return impulse >= options.minimumImpulse && energy >= breakThreshold(asset, fragment, options);
}

}  // namespace sherd
