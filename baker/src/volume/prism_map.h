// SPDX-License-Identifier: MIT
// A planarised drawing as convex cells of a plane, and which side of its lines points are on.
//
// Nodes and lines stay what they are made of, whole numbers; nothing is rounded. Where a point of a
// mesh lies on a line, the whole drawing is taken to be moved by (e^2, e) with e above 0 and
// smaller than any number (Edelsbrunner and Muecke 1990, Simulation of Simplicity): it keeps its
// shape, and of mesh and drawing no point lies on a line and no two points in one place.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "geometry/exact_grid.h"
#include "map/planar_map.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A point of a mesh in the plane of the drawing; |coordinates| at most 2^25.
struct PlanePoint {
    int64_t x = 0, y = 0;
    friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

class PrismMap {
  public:
    static constexpr uint32_t kNone = 0xFFFFFFFFU;
    /// Of the plane's unit that a step of the planar map is, and where its middle (0.5) lies.
    static constexpr int64_t kStep = 4;
    static constexpr int64_t kMiddle = int64_t{1} << 25;

    struct Side {
        uint32_t from = 0, to = 0;  ///< nodes; the cell lies left of from -> to
        uint32_t across = kNone;    ///< cell; none beyond everything
        uint32_t line = 0;          ///< the number of this edge, the same seen from both sides
    };

    /// Error: internal.
    static Result<PrismMap> of(const PlanarMap& map);

    uint32_t cells() const { return static_cast<uint32_t>(start_.size()) - 1; }
    uint32_t nodes() const { return static_cast<uint32_t>(nodes_.size()); }
    uint32_t lines() const { return static_cast<uint32_t>(lines_.size()); }
    /// Counter-clockwise.
    std::span<const Side> sides(uint32_t cell) const {
        return std::span(sides_).subspan(start_[cell], start_[cell + 1] - start_[cell]);
    }
    /// Per cell the face of the drawing that it is part of, numbered from 0.
    const std::vector<uint32_t>& faces() const { return faces_; }
    uint32_t faceCount() const { return faceCount_; }
    /// Whether a line lies between two faces.
    bool isWall(uint32_t line) const { return lines_[line].wall; }
    /// Edges of the drawing that have the same face on both sides.
    uint32_t idleEdges() const { return idleEdges_; }

    /// 1 if the point lies left of the side, -1 right.
    int sideOf(const PlanePoint& p, const Side& side) const;
    /// 1 if the node lies left of u -> v, -1 right; 0 if u and v are one point.
    int sideOf(uint32_t node, const PlanePoint& u, const PlanePoint& v) const;
    /// Whether u -> v leaves a cell over this side of it.
    bool leavesOver(const PlanePoint& u, const PlanePoint& v, const Side& side) const {
        return sideOf(v, side) < 0 && sideOf(u, side) > 0 && sideOf(side.from, u, v) < 0 &&
               sideOf(side.to, u, v) > 0;
    }

    using Integer = boost::multiprecision::int512_t;
    /// (x, y, w): the place is (x / w, y / w); below 2^92 and 2^62, w above 0.
    struct Node {
        Int128 x = 0, y = 0, w = 1;
        glm::dvec2 place{0.0};
    };
    const Node& node(uint32_t n) const { return nodes_[n]; }
    /// a x + b y + c, positive left of it as `side` runs.
    struct Line {
        std::array<Integer, 3> of;
        uint32_t from = 0, to = 0;  ///< nodes
        bool wall = false;
    };
    const Line& line(uint32_t n) const { return lines_[n]; }
    /// The line's value at a point, not perturbed; positive left of from -> to of the line.
    Integer valueAt(const PlanePoint& p, uint32_t line) const;

  private:
    friend class PrismMapBuilder;
    std::vector<Node> nodes_;
    std::vector<Line> lines_;
    std::vector<Side> sides_;
    std::vector<uint32_t> start_{0};
    std::vector<uint32_t> faces_;
    uint32_t faceCount_ = 0, idleEdges_ = 0;
};

}  // namespace sherd
