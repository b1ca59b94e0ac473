// SPDX-License-Identifier: MIT
#include "surface/split_surface.h"

#include <glm/geometric.hpp>

namespace sherd {

glm::dvec3 weightsOf(const VertexOrigin& origin, const std::array<uint32_t, 3>& meshTriangle) {
    glm::dvec3 weights(0.0);
    for (int k = 0; k < 3; ++k) {
        if (origin.weights[k] == 0) continue;
        for (int corner = 0; corner < 3; ++corner) {
            if (meshTriangle[static_cast<size_t>(corner)] !=
                origin.vertices[static_cast<size_t>(k)])
                continue;
            weights[corner] += origin.weights[k];
            break;
        }
    }
    return weights;
}

VertexOrigin middleOrigin(const VertexOrigin& a, const VertexOrigin& b,
                          const std::array<uint32_t, 3>& meshTriangle) {
    return {meshTriangle, 0.5 * (weightsOf(a, meshTriangle) + weightsOf(b, meshTriangle))};
}

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

glm::dvec3 pointOn(const SplitSurface& surface, uint32_t triangle, const glm::dvec3& weights) {
    const auto& v = surface.triangles[triangle].v;
    return glm::dvec3(surface.positions[v[0]]) * weights[0] +
           glm::dvec3(surface.positions[v[1]]) * weights[1] +
           glm::dvec3(surface.positions[v[2]]) * weights[2];
}

glm::dvec3 centroidOf(const SplitSurface& surface, uint32_t triangle) {
    const auto& v = surface.triangles[triangle].v;
    return (glm::dvec3(surface.positions[v[0]]) + glm::dvec3(surface.positions[v[1]]) +
            glm::dvec3(surface.positions[v[2]])) /
           3.0;
}

Bounds boundsOf(const SplitSurface& surface) {
    Bounds bounds;
    for (const SplitTriangle& t : surface.triangles)
        for (const uint32_t v : t.v) bounds.add(surface.positions[v]);
    return bounds;
}

double edgeLength(const SplitSurface& surface, uint32_t halfEdge) {
    const auto& v = surface.triangles[halfEdge / 3].v;
    return glm::distance(glm::dvec3(surface.positions[v[halfEdge % 3]]),
                         glm::dvec3(surface.positions[v[(halfEdge + 1) % 3]]));
}

std::vector<std::array<uint32_t, 3>> vertexTriangles(const SplitSurface& surface) {
    std::vector<std::array<uint32_t, 3>> triangles;
    triangles.reserve(surface.triangles.size());
    for (const SplitTriangle& t : surface.triangles) triangles.push_back(t.v);
    return triangles;
}

}  // namespace sherd
