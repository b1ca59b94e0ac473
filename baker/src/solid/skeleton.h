// SPDX-License-Identifier: MIT
// Where three or more pieces meet inside the solid: the lines that lead inwards from the nodes of
// the border graph.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "solid/border_graph.h"

namespace sherd {

/// Lines inside the solid. Their ends are nodes of the border graph, and hubs: points inside where
/// such lines meet. A node has one line or none.
struct Skeleton {
    struct Line {
        uint32_t from = 0, to = 0;     ///< nodes as they are numbered; hubs follow
        std::vector<uint32_t> pieces;  ///< that meet along it
    };
    std::vector<Line> lines;
    std::vector<std::vector<uint32_t>> linesAt;  ///< per end
    std::vector<glm::vec3> hubs;
    uint32_t nodes = 0;

    explicit Skeleton(size_t nodeCount)
        : linesAt(nodeCount), nodes(static_cast<uint32_t>(nodeCount)) {}
    bool isHub(uint32_t end) const { return end >= nodes; }
    uint32_t addHub(const glm::dvec3& place) {
        hubs.emplace_back(place);
        linesAt.emplace_back();
        return static_cast<uint32_t>(linesAt.size() - 1);
    }
    void addLine(uint32_t from, uint32_t to, std::vector<uint32_t> pieces) {
        for (const uint32_t end : {from, to})
            linesAt[end].push_back(static_cast<uint32_t>(lines.size()));
        lines.push_back({from, to, std::move(pieces)});
    }
    uint32_t otherEnd(uint32_t line, uint32_t end) const {
        return lines[line].from == end ? lines[line].to : lines[line].from;
    }
};

/// How nodes that have no partner share hubs.
enum class HubChoice : uint8_t {
    near,   ///< partners first; of the rest, few near ones that close around a point
    centre  ///< one hub for all nodes of a connected border
};

/// The pieces around a node, counter-clockwise seen from outside, the lowest first; reversed: as
/// they lie around its partner.
std::vector<uint32_t> piecesAround(const BorderNode& node, bool reversed);

/// Adds lines for nodes that have none.
void completeSkeleton(std::span<const glm::vec3> positions, const BorderGraph& graph,
                      HubChoice choice, Skeleton& skeleton);

}  // namespace sherd
