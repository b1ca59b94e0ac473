// SPDX-License-Identifier: MIT
// A triangle's texture coordinates on the exact grid, and what kind of triangle they make.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "geometry/exact_grid.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/result.h"
#include "surface/mesh_topology.h"

namespace sherd {

/// regular: positive area (mirrored ones are reflected, u -> -u, map and triangle alike).
/// collinear: the three corners lie on one line but not in one point: lines are conducted through.
/// point: all corners in one point; no line passes.
enum class UvKind : uint8_t { regular, mirrored, collinear, point };

struct UvTriangle {
    std::array<GridPoint, 3> corner;
    UvKind kind = UvKind::point;
};

UvKind classify(const std::array<GridPoint, 3>& corner);

/// Every triangle's UV snapped to the grid. Errors: noTextureCoordinates; limitExceeded where a
/// coordinate is beyond the grid (8 tiles), with triangle and UV.
Result<std::vector<UvTriangle>> snapUv(const SurfaceMesh& mesh);

/// The UV at a position of a mesh triangle, as lines are drawn in; for reports. Nothing for meshes
/// without.
std::optional<glm::dvec2> uvOf(const SurfaceMesh& mesh, uint32_t triangle,
                               const glm::dvec3& position);

/// Whether the two triangles glued at a half edge have different UV there. False at a border.
inline bool isUvSeam(const MeshTopology& topology, std::span<const UvTriangle> uv,
                     uint32_t halfEdge) {
    const uint32_t o = topology.opposite[halfEdge];
    if (o == kNone) return false;
    const auto at = [&](uint32_t h, uint32_t k) { return uv[h / 3].corner[(h % 3 + k) % 3]; };
    return at(halfEdge, 0) != at(o, 1) || at(halfEdge, 1) != at(o, 0);
}

}  // namespace sherd
