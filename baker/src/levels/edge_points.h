// SPDX-License-Identifier: MIT
// Where edges of the object are split. Pieces are cut one by one, but whoever has an edge has it
// split in all the points that anybody found on it: so fragments of several pieces stay closed.
// Vertices in one place are one here.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <unordered_map>
#include <vector>

namespace sherd {

class EdgePoints {
  public:
    struct Point {
        double share;  ///< of the way from the edge's lower vertex to its higher
        uint32_t vertex;
    };

    uint32_t findOrAdd(uint32_t a, uint32_t b);
    /// Once for every vertex; an end of the edge adds nothing.
    void add(uint32_t edge, double share, uint32_t vertex);
    /// Of an edge, without its ends.
    std::span<const Point> points(uint32_t edge) const { return edges_[edge].points; }

    /// When all points are known. Edges that share two vertices lie on each other and become one
    /// line, with all that lies on any of them.
    void join(const std::function<glm::dvec3(uint32_t)>& positionOf);

    /// What lies strictly between two vertices of a line, from `from` to `to`. Two vertices have
    /// one line in common at most, so this is the way along it: whichever edges the ways of a
    /// closed loop are put together of, they cancel.
    struct Part {
        std::vector<Point> points;
        double from = 0, to = 1;  ///< shares of the two vertices
    };
    Part between(uint32_t from, uint32_t to) const;

  private:
    struct Edge {
        uint32_t low, high;
        std::vector<Point> points;
    };
    using Line = std::vector<Point>;  ///< ends included

    std::vector<uint32_t> findLines() const;
    const Line* commonLine(uint32_t a, uint32_t b) const;

    std::vector<Edge> edges_;
    std::unordered_map<uint64_t, uint32_t> ofEnds_;  ///< looked up only
    std::vector<Line> lines_;
    std::unordered_map<uint32_t, std::vector<uint32_t>> linesOf_;  ///< looked up only
};

}  // namespace sherd
