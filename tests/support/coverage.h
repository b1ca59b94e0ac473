// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace sherd {

/// Triangles over positions; views only.
struct TriangleSoup {
    std::span<const glm::vec3> positions;
    std::span<const std::array<uint32_t, 3>> triangles;
};

struct CoverageOptions {
    uint32_t points = 20000;  ///< sampled inside the object
    uint32_t seed = 1;        ///< of the sampling
    double skin = 1e-6;  ///< points nearer than this to a fragment's face are skipped, in diagonals
    unsigned threads = 2;  ///< at most; the result does not depend on it
};

/// How well fragments fill their object: a sum of volumes would hide hollows behind overlaps.
struct Coverage {
    uint32_t points = 0;   ///< sampled and not skipped
    uint32_t none = 0;     ///< of these, in no fragment
    uint32_t several = 0;  ///< of these, in more than one
    double noneShare() const { return points == 0 ? 0 : static_cast<double>(none) / points; }
    double severalShare() const { return points == 0 ? 0 : static_cast<double>(several) / points; }
};

/// Seeded points inside the object (winding number >= 1), counted by the fragments they are in. An
/// object without an inside gives 0 points.
Coverage measureCoverage(const TriangleSoup& object, std::span<const TriangleSoup> fragments,
                         const CoverageOptions& options = {});

}  // namespace sherd
