// SPDX-License-Identifier: MIT
// The split surface where cells cut it.
#pragma once

#include <tuple>
#include <vector>

#include "surface/mesh_topology.h"
#include "surface/split_surface.h"
#include "volume/mesh_cut.h"

namespace sherd {

/// The skin of a cut, each triangle as part of one of the surface.
struct CutSkin {
    struct Triangle {
        std::array<uint32_t, 3> v{};
        uint32_t parent = 0;  ///< triangle of the surface
    };
    /// A vertex on an edge of the surface: (1 - t) low + t high.
    struct OnEdge {
        uint32_t low = 0, high = 0;
        double t = 0;
        uint32_t vertex = 0;
        friend bool operator==(const OnEdge&, const OnEdge&) = default;
        friend bool operator<(const OnEdge& a, const OnEdge& b) {
            return std::tie(a.low, a.high, a.t, a.vertex) < std::tie(b.low, b.high, b.t, b.vertex);
        }
    };
    std::vector<glm::vec3> positions;  ///< the surface's vertices first
    std::vector<OnEdge> places;        ///< ascending
    std::vector<uint32_t> united;      ///< per vertex of the surface: which one it has become
    std::vector<Triangle> triangles;
    std::vector<uint32_t> ofSkin;  ///< per triangle of the cut's skin; kNone: without area
    std::vector<uint32_t> vertex;  ///< per vertex of the cut; kNone: not on the skin
    uint32_t surfaceVertices = 0;  ///< as many are the surface's
};

/// kept: per triangle that the cut was made of, its number in `surface`.
CutSkin cutSkin(const SplitSurface& surface, const MeshCut& cut, std::span<const uint32_t> kept);

/// A surface with more vertices along its edges.
struct DividedSurface {
    SplitSurface surface;
    std::vector<uint32_t> parent;       ///< per triangle, of the surface before
    std::vector<uint32_t> firstOf;      ///< per triangle before and one more: its first part
    std::vector<uint32_t> vertexOfCut;  ///< per vertex of the skin; kNone: it has none
};

/// Divides edges where the skin has vertices that are wanted, and triangles along them.
DividedSurface divideEdges(const SplitSurface& before, const CutSkin& skin,
                           std::span<const uint8_t> wanted);

}  // namespace sherd
