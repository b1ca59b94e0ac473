// SPDX-License-Identifier: MIT
#include "sherd/formats/fracture_set.h"

namespace sherd {

std::vector<std::array<uint32_t, 3>> fragmentTriangles(const FractureSet& set, uint32_t fragment) {
    std::vector<std::array<uint32_t, 3>> triangles;
    const size_t primitiveCount = set.geometry.primitives.size();
    for (size_t p = 0; p < primitiveCount; ++p) {
        if (set.geometry.primitives[p].exposedFrom > set.fragments[fragment].level) continue;
        const Range range = set.fragmentRanges[fragment * primitiveCount + p];
        for (uint32_t i = 0; i + 2 < range.count; i += 3) {
            const uint32_t* corner = set.geometry.indices.data() + range.first + i;
            triangles.push_back({corner[0], corner[1], corner[2]});
        }
    }
    return triangles;
}

std::vector<uint32_t> fragmentsAtLevel(const FractureSet& set, uint32_t level) {
    std::vector<uint32_t> result;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        const Fragment& fragment = set.fragments[f];
        // A fragment may stay whole for several levels before it is divided.
        const bool standsForItself =
            fragment.level < level &&
            (fragment.children.count == 0 || set.fragments[fragment.children.first].level > level);
        if (fragment.level == level || standsForItself) result.push_back(f);
    }
    return result;
}

}  // namespace sherd
