// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

/// How the render geometry of fracture sets is stored.
struct GeometryPacking {
    enum class Encoding {
        none,   ///< floats as they are
        draco,  ///< on a grid, entropy-coded; both sides need a build with SHERD_DRACO
    };
    Encoding encoding = Encoding::none;
    /// Of one grid per object, over its longest side, 1 to 30. At 20 a step is a millionth of it:
    /// below what `check` tells apart.
    uint32_t positionBits = 20;
    uint32_t attributeBits = 12;  ///< of every other attribute, over its own values; 1 to 30
};

/// Whether this build reads and writes Draco.
bool hasDraco();

}  // namespace sherd
