// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// The distinct edges of the meshes on the picture (drawn_triangle.h): each is drawn once, however
/// many triangles use it.
struct UvWireframe {
    std::vector<glm::vec2> points;                 ///< sorted, distinct
    std::vector<std::array<uint32_t, 2>> borders;  ///< of one triangle only: where a chart ends
    std::vector<std::array<uint32_t, 2>> inner;
    size_t fromOtherTiles = 0;  ///< triangles moved onto the picture by whole tiles
    size_t beyondEdge = 0;      ///< triangles beyond the edge of a clamped texture
};

/// Meshes without texture coordinates, and edges without length in UV, give nothing.
UvWireframe uvWireframe(std::span<const SurfaceMesh> meshes);

/// The edges as few polylines: each edge in exactly one of them.
std::vector<std::vector<uint32_t>> chainEdges(size_t pointCount,
                                              std::span<const std::array<uint32_t, 2>> edges);

}  // namespace sherd
