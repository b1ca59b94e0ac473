// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "physics/solid_chain.h"

namespace sherd {

struct PartSettings {
    uint32_t most = 8;        ///< parts
    double full = 0.88;       ///< a hull filled to this share is left whole
    double worth = 0.05;      ///< a cut must save so much of the solid's volume in air
    uint32_t points = 200;    ///< of the solid: larger ones are searched on a coarser copy
    uint32_t gridCells = 12;  ///< of the copy, along its longest side
};

/// A closed solid as corners of parts that are convex, or nearly so: each part's hull holds little
/// more than it. All corners if it needs no cut. Parts do not overlap unless they were worth
/// merging again.
std::vector<std::vector<glm::dvec3>> convexParts(const SolidChain& solid,
                                                 const PartSettings& settings);

}  // namespace sherd
