// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

class Asset;

/// What decides whether a hit breaks something. World options and spawn options each carry one;
/// scales multiply, minimum values add up to the larger.
struct DamageOptions {
    float toughnessScale =
        1.0F;  ///< times the bonds' toughness x area, > 0; 2: twice the energy to break
    float minimumImpulse = 0.05F;  ///< N s; a gentler contact never breaks anything, >= 0
    float minimumEnergy =
        0.01F;  ///< J; likewise, and the floor for pieces that share no bond, >= 0
    uint32_t maxLevel = UINT32_MAX;  ///< pieces of this level do not break further; 0: unbreakable
};

/// One contact between two bodies in one substep, summed over its points.
struct Contact {
    float impulse = 0;        ///< along the normal, N s, >= 0
    float approachSpeed = 0;  ///< along the normal before the contact was solved, m/s, > 0: closing
    float effectiveMass = 0;  ///< of the two bodies at the contact point along the normal, kg
};

/// The energy a contact could spend on breaking, J: what a perfectly plastic impact would lose,
/// 1/2 m_eff v_n^2, limited by the impulse that really flowed. Supported weight and penetration
/// recovery have no approach speed and so no energy.
float contactEnergy(const Contact& contact);

/// Both options as one.
DamageOptions combine(const DamageOptions& world, const DamageOptions& object);

/// The energy, J, needed to break `fragment` into its children; infinite when it has none or
/// `options` forbid it.
float breakThreshold(const Asset& asset, uint32_t fragment, const DamageOptions& options);

/// Whether a hit of this energy and impulse breaks `fragment`.
bool breaks(const Asset& asset, uint32_t fragment, float energy, float impulse,
            const DamageOptions& options);

}  // namespace sherd
