// SPDX-License-Identifier: MIT
#include "surface/uv_triangle.h"

#include <cmath>
#include <string>

namespace sherd {

UvKind classify(const std::array<GridPoint, 3>& c) {
    const int side = signOf(orientation(c[0], c[1], c[2]));
    if (side > 0) return UvKind::regular;
    if (side < 0) return UvKind::mirrored;
    return c[0] == c[1] && c[1] == c[2] ? UvKind::point : UvKind::collinear;
}

Result<std::vector<UvTriangle>> snapUv(const SurfaceMesh& mesh) {
    const Attribute* uv = findAttribute(mesh.attributes, mesh.uvSemantic);
    if (uv == nullptr || uv->components != 2) {
        return fail(
            ErrorCode::noTextureCoordinates,
            "the mesh has no texture coordinates, and fracture lines are drawn in UV; unwrap "
            "it in a modelling tool first",
            "mesh \"" + mesh.name + "\"");
    }
    std::vector<GridPoint> grid(uv->values.size() / 2);
    for (size_t i = 0; i < grid.size(); ++i) {
        const double u = uv->values[2 * i];
        const double v = uv->values[2 * i + 1];
        constexpr double kLimit = static_cast<double>(kGridLimit) / kGridOne;
        if (!(std::abs(u) <= kLimit && std::abs(v) <= kLimit)) {
            return fail(
                ErrorCode::limitExceeded,
                "a texture coordinate lies beyond +-8 tiles, where lines cannot be followed "
                "exactly; move the chart towards [0, 1]",
                "mesh \"" + mesh.name + "\", UV (" + std::to_string(u) + ", " + std::to_string(v) +
                    ")");
        }
        grid[i] = {static_cast<int32_t>(std::lround(u * kGridOne)),
                   static_cast<int32_t>(std::lround(v * kGridOne))};
    }
    std::vector<UvTriangle> triangles(mesh.corners.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) triangles[t].corner[k] = grid[mesh.corners[t][k]];
        triangles[t].kind = classify(triangles[t].corner);
    }
    return triangles;
}

bool isUvSeam(const MeshTopology& topology, std::span<const UvTriangle> uv, uint32_t halfEdge) {
    const uint32_t o = topology.opposite[halfEdge];
    if (o == kNone) return false;
    const auto at = [&](uint32_t h, uint32_t k) { return uv[h / 3].corner[(h % 3 + k) % 3]; };
    return at(halfEdge, 0) != at(o, 1) || at(halfEdge, 1) != at(o, 0);
}

}  // namespace sherd
