// SPDX-License-Identifier: MIT
#include "surface/split_surface.h"

namespace sherd {

SplitSurface uncutSurface(const SurfaceMesh& mesh) {
    SplitSurface surface;
    surface.meshVertices = static_cast<uint32_t>(mesh.positions.size());
    surface.positions = mesh.positions;
    surface.origins.resize(mesh.positions.size());
    for (uint32_t v = 0; v < surface.meshVertices; ++v) surface.origins[v] = {{v, v, v}, {1, 0, 0}};
    surface.triangles.reserve(mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        surface.triangles.push_back({mesh.triangles[t], t, {}});
    return surface;
}

std::vector<std::array<uint32_t, 3>> vertexTriangles(const SplitSurface& surface) {
    std::vector<std::array<uint32_t, 3>> triangles;
    triangles.reserve(surface.triangles.size());
    for (const SplitTriangle& t : surface.triangles) triangles.push_back(t.v);
    return triangles;
}

}  // namespace sherd
