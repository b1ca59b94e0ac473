// SPDX-License-Identifier: MIT
// The border of a cap as segments between points of its plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/union_find.h"
#include "volume/cap_plane.h"
#include "volume/cap_space.h"

namespace sherd {

/// A directed edge of a cap's border, as the cap of the lower cell has it.
struct CapEdge {
    static constexpr uint32_t kNone = 0xFFFFFFFFU;
    uint32_t from, to;  ///< vertices of the cut
    int times;
    uint32_t triangle;  ///< whose section it is; kNone: of an edge of the cells
};

/// All uses of an edge of the border added up.
struct BorderSegment {
    uint32_t a, b;      ///< points, a < b
    int times;          ///< net, from a to b; not 0
    uint32_t triangle;  ///< one whose section it is; CapEdge::kNone: none
};

class CapBorder {
  public:
    static constexpr uint32_t kCorners = 3;  ///< points 0 to 2: a triangle around everything

    CapBorder(CapSpace& vertices, UnionFind& merged) : vertices_(vertices), merged_(merged) {}

    /// That of the face i|j; vertices that `merged` unites are one point.
    void start(uint32_t i, uint32_t j, std::span<const CapEdge> edges);

    CapPlane& plane() { return plane_; }
    uint32_t points() const { return kCorners + static_cast<uint32_t>(vertexOf_.size()); }
    uint32_t vertex(uint32_t point) const { return vertexOf_[point - kCorners]; }
    const std::vector<BorderSegment>& segments() const { return segments_; }
    /// The net use of an edge in that direction.
    int timesOf(uint32_t from, uint32_t to) const;

    /// The point that is a vertex, a new one where there is none.
    uint32_t pointAt(uint32_t vertex);
    /// The segment's first part, up to the point, becomes another segment; it goes on from there.
    /// As the skin has one edge there and the cap two, a flat triangle joins them.
    void split(uint32_t segment, uint32_t through);
    /// To be called after splits.
    void settle();
    /// The flat triangles of all splits, of points.
    const std::vector<std::array<uint32_t, 3>>& sewn() const { return sewn_; }

  private:
    void collectPoints(std::span<const CapEdge> edges);
    uint32_t pointOf(uint32_t vertex);
    void addUp();

    CapSpace& vertices_;
    UnionFind& merged_;
    CapPlane plane_;
    std::vector<uint32_t> vertexOf_;  ///< point - kCorners: vertex; ascending but for later ones
    std::vector<BorderSegment> segments_;
    std::vector<std::array<uint32_t, 3>> sewn_;
};

}  // namespace sherd
