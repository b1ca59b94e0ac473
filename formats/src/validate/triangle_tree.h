// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// Distances to a set of triangles: a binary tree of bounding boxes, split at the median.
class TriangleTree {
  public:
    TriangleTree(const std::vector<glm::vec3>& positions,
                 const std::vector<std::array<uint32_t, 3>>& triangles);

    /// Distance to the nearest triangle; stops as soon as it is known to be at most `enough`.
    double distance(const glm::dvec3& point, double enough) const;

  private:
    struct Node {
        glm::vec3 low{0};
        glm::vec3 high{0};
        uint32_t first = 0;  ///< triangles of a leaf, or the second child
        uint32_t count = 0;  ///< 0: an inner node, its first child follows it
    };
    uint32_t build(uint32_t begin, uint32_t end);

    const std::vector<glm::vec3>& positions_;
    std::vector<std::array<uint32_t, 3>> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace sherd
