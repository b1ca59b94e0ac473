// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "interior/stitching.h"

namespace sherd {

/// The solid the pieces are cut from.
struct SolidTest {
    const InsideTest* inside;  ///< null: an open surface, of which nothing is outside
    const TriangleBvh& surface;
    double skin;  ///< metres: nearer to the surface than this is not outside

    bool contains(const glm::dvec3& p) const { return inside == nullptr || inside->inside(p); }
};

struct Containment {
    uint32_t pulled = 0;      ///< hidden points moved towards the surface
    uint32_t protruding = 0;  ///< faces that stick out even so
};

/// Where hidden faces stick out of the solid (by their corners, the middles of their sides and
/// their centroids), their hidden points go back towards their feet by halves, and at last onto
/// them.
Containment keepInside(const SolidTest& object, const SplitSurface& surface,
                       std::span<const HiddenFace> faces, unsigned threads, HiddenSheet& sheet);

}  // namespace sherd
