// SPDX-License-Identifier: MIT
// Random closed meshes, aligned on purpose: their faces, edges and vertices meet planes and each
// other all the time.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "support/property.h"

namespace sherd::test {

/// Closed over vertex ids. Vertices in one place may be one or several.
struct Solid {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
    /// Winding numbers are 0 and 1 only and no two parts touch: pieces cannot touch themselves.
    bool simple = true;

    void append(const Solid& other);
    void turnInsideOut();
    template <class F>
    void transform(const F& f) {
        for (glm::vec3& p : positions) p = f(p);
    }
};

/// An axis-parallel box of n x n quads a side, its vertices on multiples of (high - low) / n.
Solid boxSolid(const glm::vec3& low, const glm::vec3& high, int n = 1);
/// `across` >= 3, `along` >= 2: triangle count 2 across (along - 1).
Solid sphereSolid(const glm::vec3& centre, const glm::vec3& radii, int across, int along);
Solid torusSolid(float major, float minor, int around, int across);
/// The unit cubes of a block that are full, inner faces left out; cubes may touch in an edge or a
/// vertex, where they share vertices.
Solid blockSolid(Random& random, const std::array<int, 3>& size, double full);

/// One of these or several: apart, touching, overlapping, one in a hollow of another; up to 500
/// triangles; coordinates of a few units, multiples of 1/4 where `aligned` (true half of the time)
/// is chosen.
Solid randomSolid(Random& random);

}  // namespace sherd::test
