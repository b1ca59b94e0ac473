// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

struct ThicknessOptions {
    uint32_t samples = 256;  ///< per fragment, 1 or more
    double share = 0.1;      ///< of a fragment's surface that counts as its thinnest part
    uint32_t seed = 1;
    unsigned threads = 2;  ///< at most; the result does not depend on it
};

/// Per fragment, in metres, how thick its thinnest part is: from a point of the surface straight
/// inwards to where the fragment ends; as much as `share` of its surface has at most. (The least of
/// all such lengths is 0 for every piece with a sharp edge, however thick.) 0: it has no surface.
std::vector<double> thinnestParts(const FractureSet& set, const ThicknessOptions& options = {});

}  // namespace sherd
