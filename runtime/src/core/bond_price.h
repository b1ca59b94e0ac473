// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "sherd/runtime/asset.h"
#include "sherd/runtime/damage.h"

namespace sherd {

/// What the options make of the bonds that part a fragment of some level.
inline float levelScale(const Asset& asset, const BondGraph::Bond& bond,
                        const DamageOptions& options) {
    if (options.levelScale == 1) return 1;
    return std::pow(options.levelScale, float(asset.fragment(bond.parting).level));
}

/// Energy that breaking the sound bond consumes, J.
inline float priceOf(const Asset& asset, const BondGraph::Bond& bond,
                     const DamageOptions& options) {
    return bond.energy * options.toughnessScale * levelScale(asset, bond, options);
}

/// Stress at which it starts to fail, Pa.
inline float strengthOf(const Asset& asset, const BondGraph::Bond& bond,
                        const DamageOptions& options) {
    return bond.strength * options.strengthScale * levelScale(asset, bond, options);
}

}  // namespace sherd
