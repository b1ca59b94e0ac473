// SPDX-License-Identifier: MIT
// Refinement of a triangulation by bisection, without hanging vertices.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sherd {

/// Triangles that refine others, their parents. Half edge 3 * triangle + k runs from corner k to
/// corner k + 1.
struct BisectedTriangles {
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    struct Triangle {
        std::array<uint32_t, 3> v;
        uint32_t parent;
        std::array<uint32_t, 3> along;  ///< the parents' half edge that side k lies on; kNone: side
                                        ///< k lies inside the parent
        uint32_t node;                  ///< in nodes
    };
    /// Every triangle there ever was. Cut at the middle of its side, it has the half with that
    /// side's start as child, and the other half next to it.
    struct Node {
        std::array<uint32_t, 3> v;
        uint32_t child = kNone;  ///< kNone: not cut
        uint32_t side = 0;
    };
    std::vector<Triangle> triangles;
    std::vector<uint32_t> opposite;  ///< per half edge: the one it is glued to; kNone: none
    std::vector<Node> nodes;         ///< the parents come first, in their order

    BisectedTriangles() = default;
    /// The parents themselves, glued as `opposite` says.
    BisectedTriangles(std::span<const std::array<uint32_t, 3>> parents,
                      std::span<const uint32_t> opposite);

    /// The vertices of the triangle in which a place of a parent lies, and its weights there. The
    /// weights given are those of the parent's corners; so are the ones returned, of v.
    struct Located {
        std::array<uint32_t, 3> v;
        glm::dvec3 weights;
    };
    Located locate(uint32_t parent, const glm::dvec3& weights) const;
};

/// Marks, beside the sides marked already, what lies opposite of them and the longest side of every
/// triangle that has one marked: so triangles stay in shape. M. C. Rivara, "Algorithms for refining
/// triangular grids suitable for adaptive and multigrid techniques" (1984). `marked` is per half
/// edge, `marks` lists those marked, what is added at its end; length2(halfEdge) is the same from
/// both sides.
void closeMarks(const BisectedTriangles& mesh,
                const std::function<double(uint32_t halfEdge)>& length2,
                std::vector<uint32_t>& marks, std::vector<uint8_t>& marked);

/// Cuts all marked sides in their middle. middle[h] is the new vertex of side h, the same from both
/// sides; marks must be closed, by the same length. Triangles that are not cut keep their numbers;
/// returns those that are new. `kept`, if given, says something of each half edge: sides that stay
/// whole keep it, new ones have 0.
std::vector<uint32_t> bisect(BisectedTriangles& mesh, std::span<const uint8_t> marked,
                             std::span<const uint32_t> middle,
                             const std::function<double(uint32_t halfEdge)>& length2,
                             std::vector<uint8_t>* kept = nullptr);

/// Brings the triangles into the order of their parents.
void sortByParent(BisectedTriangles& mesh, unsigned threads = 1);

}  // namespace sherd
