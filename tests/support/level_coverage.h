// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/fracture_set.h"
#include "support/coverage.h"

namespace sherd::test {

/// Of points in the object: none in no piece or several, at any level.
inline void checkCovered(const FractureSet& set, const SurfaceMesh& mesh, uint32_t points) {
    for (uint32_t level = 1; level < set.levels.size(); ++level) {
        CAPTURE(level);
        std::vector<std::vector<std::array<uint32_t, 3>>> triangles;
        for (const uint32_t f : fragmentsAtLevel(set, level))
            triangles.push_back(fragmentTriangles(set, f));
        std::vector<TriangleSoup> pieces;
        pieces.reserve(triangles.size());
        for (const auto& piece : triangles) pieces.push_back({set.geometry.positions, piece});
        CoverageOptions options;
        options.points = points;
        const Coverage coverage =
            measureCoverage({mesh.positions, mesh.triangles}, pieces, options);
        CHECK(coverage.none == 0);
        CHECK(coverage.several == 0);
    }
}

}  // namespace sherd::test
