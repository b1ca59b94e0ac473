// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "geometry/lanes.h"

namespace sherd {

/// The triangles of a mesh in a tree, four children to a node and four triangles to a leaf, laid
/// out for looking at four at once. Each child also knows the slab of its points.
struct BallNodes {
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    static constexpr uint32_t kWidth = Lanes::kWidth;
    static constexpr uint32_t kLeaf = 1U << 31;  ///< marks leaves among children

    /// What is below. Boxes are centre +- extent; all points of a child have low <= normal.q <=
    /// high.
    struct Node {
        LanesOfPoints centre, extent, normal;
        Lanes low, high;
        std::array<uint32_t, kWidth> child;  ///< node, or with kLeaf set a leaf; kNone: no child
    };
    /// Leaf i has triangles 4 i to 4 i + 3: around each a ball, and its plane.
    struct Leaf {
        LanesOfPoints middle, normal;  ///< normals unit, 0 for slivers
        Lanes radius, offset;          ///< planes are normal.q = offset
    };
    /// A corner and the sides from it, and as fourth numbers ab.ac, ab.ab and ac.ac.
    struct Triangle {
        Lanes a, ab, ac;
    };
    /// A triangle and those across its sides (itself where there is none), and their planes.
    struct Fan {
        LanesOfPoints normal;
        Lanes offset;
        std::array<uint32_t, kWidth> members;
    };

    std::vector<Node> nodes;
    std::vector<Leaf> leaves;
    std::vector<Triangle> triangles;  ///< in the order of the leaves
    std::vector<Fan> fans;            ///< per triangle
    std::vector<uint32_t> numbers;    ///< per triangle: in the mesh
    uint32_t root = kNone;            ///< as a child
};

/// The sine squared of the angle between two sides below which a triangle counts as its edges.
inline constexpr float kSliver = 1e-10F;

/// Positions finite and of a size near 1; opposite per half edge as in MeshTopology.
BallNodes buildBallNodes(std::span<const glm::vec3> positions,
                         std::span<const std::array<uint32_t, 3>> triangles,
                         std::span<const uint32_t> opposite, unsigned threads);

}  // namespace sherd
