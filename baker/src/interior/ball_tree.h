// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sherd {

/// Tangent balls between triangles. A ball that touches the surface at p and at q sees the two
/// under its separation angle; contacts under less than a given angle are passed over, so that
/// neither the triangles around p nor small bumps beside it shrink the ball.
class BallTree {
  public:
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

    /// Where balls touch the surface: point and unit normal, outwards.
    struct Tangent {
        glm::vec3 point, normal;
    };
    /// The centre is point - radius * normal.
    struct Ball {
        float radius = 0;
        uint32_t contact = kNone;  ///< the triangle it touches across, by the tree's own number;
                                   ///< kNone: it is as large as allowed
    };

    /// Copies what it needs. Positions finite and of a size near 1; indices below positions.size();
    /// opposite per half edge as in MeshTopology. separationAngle in radians, 0..pi.
    BallTree(std::span<const glm::vec3> positions,
             std::span<const std::array<uint32_t, 3>> triangles, std::span<const uint32_t> opposite,
             double separationAngle, unsigned threads = 1);

    /// The largest ball that no triangle enters by more than two percent of its radius, and
    /// what it touches not by more than a thousandth; at most
    /// maxRadius, 0 below a hundred-thousandth. `near`, if given, is where a ball beside touches:
    /// the search ends sooner.
    Ball largest(const Tangent& tangent, float maxRadius, uint32_t near = kNone) const;

    /// Shrinks a ball to what the contacts of balls beside it say, each followed over the mesh to
    /// where the ball is smallest. In almost all places this is the largest ball; where the medial
    /// surface has a branch that no ball beside knows of, it is larger.
    Ball beside(const Tangent& tangent, Ball ball, std::span<const uint32_t> contacts) const;

  private:
    struct Query;
    struct Node {
        glm::vec3 centre, extent;   ///< box: centre +- extent
        glm::vec3 normal{1, 0, 0};  ///< with low and high: all points have low <= normal.q <= high
        float low = -1e30F, high = 1e30F;
        uint32_t first = 0;  ///< leaf: first triangle; inner node: right child (left one is next)
        uint32_t count = 0;  ///< triangles of a leaf, 0 for inner nodes
    };
    struct Triangle {
        glm::vec3 a, b, c;
        glm::vec3 normal;  ///< unit; 0 for slivers
        glm::vec3 middle;  ///< of a ball around the triangle
        float extent;      ///< radius of that ball
    };
    static constexpr uint32_t kLeafSize = 4;
    static constexpr uint32_t kSlabSize = 512;  ///< larger patches are not flat

    struct Subtree {
        uint32_t first, last;  ///< of the order
        uint32_t root;         ///< node
    };
    static uint32_t nodesOf(uint32_t triangles);
    void build(std::span<uint32_t> order, const Subtree& at, unsigned threads);
    void setBox(Node& node, std::span<const uint32_t> members) const;
    void setSlab(Node& node, std::span<const uint32_t> members) const;
    void renumber(std::span<const uint32_t> order, std::span<const uint32_t> opposite);
    void search(Query& query) const;
    bool shrinkBy(Query& query, uint32_t triangle) const;
    void follow(Query& query, uint32_t triangle) const;
    Ball settled(Query& query) const;
    bool meets(const Query& query, const Node& node) const;

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;
    std::vector<std::array<uint32_t, 3>> beside_;  ///< per triangle: those across its sides
    float sinHalf_;                                ///< of half the separation angle
};

}  // namespace sherd
