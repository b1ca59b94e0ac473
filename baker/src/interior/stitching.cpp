// SPDX-License-Identifier: MIT
#include "interior/stitching.h"

#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

CornerRef outer(uint32_t corner) {
    return {corner, 0};
}
CornerRef below(uint32_t corner) {
    return {corner, 1};
}

/// Per leaf: whether the part of the surface it belongs to is divided at all. Such a part is closed
/// by sheets from level 1 on, even where only a deeper level divides it: so the pieces of a level
/// add up to those of the level before, always.
std::vector<uint8_t> inDividedParts(const SplitSurface& surface, const MeshTopology& topology,
                                    const Components& components) {
    UnionFind parts(components.leafCount);
    std::vector<uint8_t> hasBorder(components.leafCount, 0);
    for (uint32_t h = 0; h < 3 * surface.triangles.size(); ++h) {
        const uint32_t leaf = components.leaf[h / 3];
        const uint32_t o = topology.opposite[h];
        if (o != kNone && components.leaf[o / 3] == leaf) continue;
        hasBorder[leaf] = 1;
        if (o != kNone) parts.unite(leaf, components.leaf[o / 3]);
    }
    std::vector<uint8_t> divided(components.leafCount, 0);
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
        if (hasBorder[leaf] != 0) divided[parts.find(leaf)] = 1;
    }
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
        divided[leaf] = divided[parts.find(leaf)];
    return divided;
}

/// The wall below the half edge p -> q: q, p, M(p), M(q). Both sides of a border take the same
/// diagonal, from the lower vertex.
void addWall(const SplitSurface& surface, uint32_t halfEdge, HiddenFace face,
             std::vector<HiddenFace>& faces) {
    const uint32_t p = halfEdge;
    const uint32_t q = nextCorner(halfEdge);
    face.wall = true;
    const bool lowIsP = surface.triangles[p / 3].v[p % 3] < surface.triangles[q / 3].v[q % 3];
    if (lowIsP) {
        face.corners = {outer(q), outer(p), below(q)};
        faces.push_back(face);
        face.corners = {outer(p), below(p), below(q)};
    } else {
        face.corners = {outer(q), outer(p), below(p)};
        faces.push_back(face);
        face.corners = {outer(q), below(p), below(q)};
    }
    faces.push_back(face);
}

}  // namespace

std::vector<HiddenFace> stitch(const SplitSurface& surface, const MeshTopology& topology,
                               const Components& components) {
    const std::vector<uint8_t> divided = inDividedParts(surface, topology, components);
    std::vector<HiddenFace> faces;
    faces.reserve(surface.triangles.size() + surface.triangles.size() / 4);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const uint32_t leaf = components.leaf[t];
        HiddenFace face;
        face.leaf = leaf;
        if (divided[leaf] != 0) {
            face.exposedFrom = 1;
            face.corners = {below(3 * t + 2), below(3 * t + 1), below(3 * t)};
            faces.push_back(face);
        }
        for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            const uint32_t o = topology.opposite[h];
            face.neighbour = o == kNone ? kNone : components.leaf[o / 3];
            if (face.neighbour == leaf) continue;
            face.exposedFrom = o == kNone ? 1 : components.separatedFrom(leaf, face.neighbour);
            addWall(surface, h, face, faces);
        }
    }
    return faces;
}

std::vector<std::array<uint32_t, 3>> levelTopology(const SplitSurface& surface,
                                                   const MeshTopology& topology,
                                                   const Components& components,
                                                   std::span<const HiddenFace> hidden,
                                                   uint32_t level) {
    const auto cornerCount = static_cast<uint32_t>(3 * surface.triangles.size());
    UnionFind fan(cornerCount);
    for (uint32_t h = 0; h < cornerCount; ++h) {
        const uint32_t o = topology.opposite[h];
        if (o == kNone || o < h) continue;
        if (components.at(level, components.leaf[h / 3]) !=
            components.at(level, components.leaf[o / 3]))
            continue;
        fan.unite(h, nextCorner(o));
        fan.unite(nextCorner(h), o);
    }
    std::vector<std::array<uint32_t, 3>> triangles;
    triangles.reserve(surface.triangles.size() + hidden.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        triangles.push_back(
            {2 * fan.find(3 * t), 2 * fan.find(3 * t + 1), 2 * fan.find(3 * t + 2)});
    }
    for (const HiddenFace& face : hidden) {
        if (face.exposedFrom > level) continue;
        std::array<uint32_t, 3> ids{};
        for (size_t k = 0; k < 3; ++k)
            ids[k] = 2 * fan.find(face.corners[k].corner) + face.corners[k].hidden;
        triangles.push_back(ids);
    }
    return triangles;
}

}  // namespace sherd
