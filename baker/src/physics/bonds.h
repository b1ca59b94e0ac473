// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// A triangle of a leaf's hidden surface, seen from outside the leaf.
struct HiddenTriangle {
    std::array<uint32_t, 3> vertices{};  ///< into positions
    uint32_t leaf = 0;
};

struct BondOptions {
    double sheetTolerance = 0;  ///< metres: how far apart facing sheets may be and still hold
    unsigned threads = 1;       ///< does not change the result
};

/// Two leaves and the hidden area they share.
struct LeafBond {
    uint32_t a = 0;  ///< below b
    uint32_t b = 0;
    double area = 0;                   ///< m^2
    glm::dvec3 centroid{0.0};          ///< of the shared area
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit, from a to b
};

/// Sorted by a, then b.
std::vector<LeafBond> findBonds(std::span<const glm::vec3> positions,
                                std::span<const HiddenTriangle> triangles,
                                const BondOptions& options);

}  // namespace sherd
