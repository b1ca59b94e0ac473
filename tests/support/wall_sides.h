// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>

#include "sherd/formats/fracture_set.h"
#include "support/hidden_looks.h"

namespace sherd::test {

/// Hidden triangles that a leaf has and no other has from its other side, bit by bit.
inline size_t unpairedFaces(const FractureSet& set) {
    const auto& p = set.geometry.positions;
    std::map<std::array<std::array<float, 3>, 3>, int> sides;
    for (const SeenFace& face : hiddenFacesOf(set)) {
        std::array<std::array<float, 3>, 3> corners;
        for (size_t k = 0; k < 3; ++k)
            corners[k] = {p[face.v[k]].x, p[face.v[k]].y, p[face.v[k]].z};
        if (glm::length(face.normal) < 1e-10) continue;
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                    corners.end());
        const bool turned = corners[2] < corners[1];
        if (turned) std::swap(corners[1], corners[2]);
        sides[corners] += turned ? -1 : 1;
    }
    return static_cast<size_t>(std::count_if(sides.begin(), sides.end(),
                                             [](const auto& side) { return side.second != 0; }));
}

}  // namespace sherd::test
