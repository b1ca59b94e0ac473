// SPDX-License-Identifier: MIT
// The centre lines of a drawing as a graph, in texels: texel (x, y) has its centre at
// (x + 0.5, y + 0.5).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sherd {

inline constexpr uint32_t kNoNode = UINT32_MAX;

struct CentrePoint {
    glm::dvec2 at{0.0};
    double radius = 0;  ///< half the drawn line's width there
};

struct CentreNode {
    glm::dvec2 at{0.0};
    double radius = 0;            ///< of the largest disc of ink there
    std::vector<uint32_t> lines;  ///< that end here; one that comes back is listed twice
};

struct CentreLine {
    uint32_t from = kNoNode, to = kNoNode;  ///< both kNoNode: closed, without a node
    std::vector<CentrePoint> points;        ///< the nodes' included; a closed line's first repeated
    bool dead = false;                      ///< taken out of the drawing

    bool closed() const { return from == kNoNode; }
};

struct CentreGraph {
    std::vector<CentreNode> nodes;
    std::vector<CentreLine> lines;

    size_t degree(uint32_t node) const { return nodes[node].lines.size(); }
    /// Neither a closed line nor one that comes back to where it started.
    bool hasTwoEnds(const CentreLine& line) const { return line.from != line.to; }
};

double lengthOf(const CentreLine& line);
/// Turns the line round.
void reverse(CentreLine& line);
void removeLine(CentreGraph& graph, uint32_t line);
/// A node with two line ends goes, its lines become one (or one closed line). Others stay.
void dissolve(CentreGraph& graph, uint32_t node);

}  // namespace sherd
