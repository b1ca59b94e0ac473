// SPDX-License-Identifier: MIT
// How colliders fit: measured from the corners that are written, sharing nothing with how they were
// found.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sherd/baker/report.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

struct ColliderMeasureOptions {
    uint32_t points = 40000;  ///< sampled in all fragments together; 64 to 512 in each
    uint32_t seed = 1;
    unsigned threads = 2;  ///< at most; the result does not depend on it
};

/// Fills the colliders' entries of the report's fragments and levels, and adds findings where they
/// do not hold to what is accepted. Needs the report's fragments, levels and diagonal.
void measureColliders(const FractureSet& set, const ColliderMeasureOptions& options,
                      BakedObjectReport& report);

}  // namespace sherd
