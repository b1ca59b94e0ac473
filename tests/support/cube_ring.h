// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/baker/fracture_map.h"
#include "support/surface_meshes.h"

namespace sherd::test {

/// A line around the charted cube, at 0.4 of its height.
inline FractureMap ringAroundCube() {
    FractureMap map;
    for (int face : {0, 1})
        map.lines.push_back({{cubeUv(face, -0.01, 0.4), cubeUv(face, 1.01, 0.4)}, 1, "ring"});
    for (int face : {2, 3})
        map.lines.push_back({{cubeUv(face, 0.4, -0.01), cubeUv(face, 0.4, 1.01)}, 1, "ring"});
    return map;
}

}  // namespace sherd::test
