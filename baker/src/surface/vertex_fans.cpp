// SPDX-License-Identifier: MIT
#include "surface/vertex_fans.h"

#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {

uint32_t separateFans(const MeshTopology& topology, SurfaceMesh& mesh) {
    const auto cornerCount = static_cast<uint32_t>(3 * mesh.triangles.size());
    UnionFind fans(cornerCount);
    for (uint32_t h = 0; h < cornerCount; ++h) {
        const uint32_t o = topology.opposite[h];
        if (o == kNone || o < h) continue;
        fans.unite(h, nextCorner(o));
        fans.unite(nextCorner(h), o);
    }
    // The first fan of a vertex keeps it.
    std::vector<uint32_t> owner(mesh.positions.size(), kNone);
    std::vector<uint32_t> vertexOfFan(cornerCount, kNone);
    uint32_t copies = 0;
    for (uint32_t c = 0; c < cornerCount; ++c) {
        uint32_t& vertex = mesh.triangles[c / 3][c % 3];
        const uint32_t fan = fans.find(c);
        if (topology.degenerate[c / 3] != 0) continue;
        if (vertexOfFan[fan] == kNone) {
            vertexOfFan[fan] = vertex;
            if (owner[vertex] != kNone) {
                vertexOfFan[fan] = static_cast<uint32_t>(mesh.positions.size());
                mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
                ++copies;
            } else {
                owner[vertex] = fan;
            }
        }
        vertex = vertexOfFan[fan];
    }
    return copies;
}

}  // namespace sherd
