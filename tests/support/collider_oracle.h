// SPDX-License-Identifier: MIT
// What a written collider is, told from its corners and margin alone and by brute force: no hull,
// no search and no tolerance of the baker's or the formats' is used.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd::test {

/// The convex hull of some corners, and all that is within `margin` of it.
class RoundedHull {
  public:
    RoundedHull(std::vector<glm::dvec3> corners, double margin);

    double margin() const { return margin_; }
    std::vector<glm::dvec3> normals() const;
    /// 0 within, margin included.
    double distance(const glm::dvec3& p) const;
    /// How far the corners reach along a unit direction; without the margin.
    double reach(const glm::dvec3& direction) const;

  private:
    friend double apart(const RoundedHull& a, const RoundedHull& b, double enough);
    struct Face {
        std::array<uint32_t, 3> corners;
        glm::dvec3 normal;
        double offset;
    };
    std::vector<glm::dvec3> corners_;
    double margin_;
    std::vector<Face> faces_;  ///< of every three corners that have all others behind them
    std::vector<std::array<uint32_t, 2>> edges_;
};

/// The widest gap between both along any direction in which a shortest way between convex bodies
/// may go, margins included: below 0, how deep they are in each other. Each direction is a proof by
/// itself, so the search ends at one that shows `enough`.
double apart(const RoundedHull& a, const RoundedHull& b, double enough);

std::vector<RoundedHull> colliderOf(const FractureSet& set, uint32_t fragment);

/// A closed piece as it was written.
class WrittenPiece {
  public:
    WrittenPiece(const FractureSet& set, uint32_t fragment);

    const std::vector<std::array<glm::dvec3, 3>>& triangles() const { return triangles_; }
    /// Of triangles that show on the object as it was.
    const std::vector<glm::dvec3>& skin() const { return skin_; }
    const glm::dvec3& low() const { return low_; }
    const glm::dvec3& high() const { return high_; }
    double size() const;    ///< of the longest side of its box
    double volume() const;  ///< of its triangles
    /// How often the surface goes around a point: the sum of solid angles (A. Van Oosterom and
    /// J. Strackee, 1983).
    double winding(const glm::dvec3& p) const;
    /// How far any corner lies above the plane of any triangle that is no sliver: 0 for a convex
    /// piece of one part.
    double bulge() const;
    double reach(const glm::dvec3& direction) const;

  private:
    std::vector<std::array<glm::dvec3, 3>> triangles_;
    std::vector<glm::dvec3> corners_, skin_;
    glm::dvec3 low_{0.0}, high_{0.0};
};

}  // namespace sherd::test
