// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "interior/ball_nodes.h"

namespace sherd {

/// Tangent balls between triangles. A ball that touches the surface at p and at q sees the two
/// under its separation angle; contacts under less than a given angle are passed over, so that
/// neither the triangles around p nor small bumps beside it shrink the ball.
class BallTree {
  public:
    static constexpr uint32_t kNone = BallNodes::kNone;

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

    /// The largest ball that no triangle enters by more than four percent of its radius, and
    /// what it touches not by more than a thousandth; at most
    /// maxRadius, 0 below a hundred-thousandth. `near`, if given, is where a ball beside touches:
    /// the search ends sooner.
    Ball largest(const Tangent& tangent, float maxRadius, uint32_t near = kNone) const;

    /// Shrinks a ball to what the contacts of balls beside it say, each followed over the mesh to
    /// where the ball is smallest. In almost all places this is the largest ball; where the medial
    /// surface has a branch that no ball beside knows of, it is larger.
    Ball beside(const Tangent& tangent, Ball ball, std::span<const uint32_t> contacts) const;

    /// The mesh's triangles, near ones near each other.
    std::span<const uint32_t> order() const { return nodes_.numbers; }

  private:
    struct Query;

    /// Of a node; see childrenMet.
    struct Children {
        bool any = false;
        Lanes distance2;
    };

    void search(Query& query) const;
    Children childrenMet(const Query& query, const BallNodes::Node& node) const;
    void shrinkByLeaf(Query& query, uint32_t leaf) const;
    uint32_t shrinkBySome(Query& query, const std::array<uint32_t, 4>& triangles) const;
    void shrinkToMiddle(Query& query, uint32_t triangle) const;
    void follow(Query& query, uint32_t triangle) const;
    Ball settled(Query& query) const;

    BallNodes nodes_;
    float sinHalf_;  ///< of half the separation angle
};

}  // namespace sherd
