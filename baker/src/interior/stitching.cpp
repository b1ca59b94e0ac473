// SPDX-License-Identifier: MIT
#include "interior/stitching.h"

#include <map>

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

/// Appends the wall below a border of the split surface, half edge p -> q, piece by piece: the part
/// below the sheet's half edge a -> b on it. From the lower of p and q a fan goes over the hidden
/// points, so that both sides of a border make the same triangles.
void addWall(const SplitSurface& surface, const HiddenSheet& sheet, uint32_t sheetHalfEdge,
             HiddenFace face, std::vector<HiddenFace>& faces) {
    const uint32_t a = sheetHalfEdge;
    const uint32_t b = nextCorner(a);
    const uint32_t p = sheet.triangles[a / 3].along[a % 3];
    const uint32_t q = nextCorner(p);
    const uint32_t pVertex = surface.triangles[p / 3].v[p % 3];
    const uint32_t qVertex = surface.triangles[q / 3].v[q % 3];
    const bool lowIsP = pVertex < qVertex;
    face.wall = true;
    const uint32_t far = lowIsP ? b : a;
    if (sheet.triangles[far / 3].v[far % 3] == (lowIsP ? qVertex : pVertex)) {
        face.corners = {outer(q), outer(p), below(far)};
        faces.push_back(face);
    }
    face.corners = {outer(lowIsP ? p : q), below(a), below(b)};
    faces.push_back(face);
}

}  // namespace

std::vector<HiddenFace> stitch(const SplitSurface& surface, const MeshTopology& topology,
                               const HiddenSheet& sheet, const Components& components,
                               const SolidLeaves& solid) {
    const std::vector<uint8_t> divided = inDividedParts(surface, topology, components);
    std::vector<HiddenFace> faces;
    faces.reserve(sheet.triangles.size() + sheet.triangles.size() / 4);
    for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
        const uint32_t leaf = components.leaf[sheet.triangles[t].parent];
        if (solid.contains(leaf)) continue;
        HiddenFace face;
        face.leaf = leaf;
        if (divided[leaf] != 0) {
            face.exposedFrom = 1;
            face.corners = {below(3 * t + 2), below(3 * t + 1), below(3 * t)};
            faces.push_back(face);
        }
        for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            const uint32_t along = sheet.triangles[t].along[h % 3];
            if (along == kNone) continue;
            const uint32_t o = topology.opposite[along];
            face.neighbour = o == kNone ? kNone : components.leaf[o / 3];
            if (face.neighbour == leaf) continue;
            face.exposedFrom = o == kNone || solid.contains(face.neighbour)
                                   ? 1
                                   : components.separatedFrom(leaf, face.neighbour);
            addWall(surface, sheet, h, face, faces);
        }
    }
    faces.insert(faces.end(), solid.faces.begin(), solid.faces.end());
    return faces;
}

namespace {

/// Corners around one vertex that hang together within one body: one id for each such fan.
template <class BodyOf>
UnionFind fansOf(std::span<const uint32_t> opposite, const BodyOf& bodyOf) {
    const auto cornerCount = static_cast<uint32_t>(opposite.size());
    UnionFind fan(cornerCount);
    for (uint32_t h = 0; h < cornerCount; ++h) {
        const uint32_t o = opposite[h];
        if (o == kNone || o < h || bodyOf(h / 3) != bodyOf(o / 3)) continue;
        fan.unite(h, nextCorner(o));
        fan.unite(nextCorner(h), o);
    }
    return fan;
}

/// One id for each fan around those vertices from `first` on that are odd; new ones follow
/// `last`. Triangles meet over edges that are used once in each direction.
void separateHubs(uint32_t first, uint32_t last, std::span<std::array<uint32_t, 3>> triangles) {
    const auto isHub = [first](uint32_t id) { return id >= first && id % 2 == 1; };
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> edges;  // directed: half edges
    for (uint32_t h = 0; h < 3 * triangles.size(); ++h) {
        const uint32_t a = triangles[h / 3][h % 3], b = triangles[h / 3][(h % 3 + 1) % 3];
        if (isHub(a) || isHub(b)) edges[{a, b}].push_back(h);
    }
    UnionFind fans(3 * triangles.size());
    for (const auto& [ends, uses] : edges) {
        const auto back = edges.find({ends.second, ends.first});
        if (uses.size() != 1 || back == edges.end() || back->second.size() != 1) continue;
        fans.unite(uses[0], nextCorner(back->second[0]));
        fans.unite(nextCorner(uses[0]), back->second[0]);
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> idOfFan;
    std::map<uint32_t, uint32_t> taken;  // the first fan keeps the id
    for (uint32_t c = 0; c < 3 * triangles.size(); ++c) {
        uint32_t& id = triangles[c / 3][c % 3];
        if (!isHub(id)) continue;
        const uint32_t fan = fans.find(c);
        if (taken.try_emplace(id, fan).first->second == fan) continue;
        const auto [it, isNew] = idOfFan.try_emplace({id, fan}, last + 2);
        if (isNew) last += 2;
        id = it->second;
    }
}

}  // namespace

std::vector<std::array<uint32_t, 3>> levelTopology(const SplitSurface& surface,
                                                   const MeshTopology& topology,
                                                   const HiddenSheet& sheet,
                                                   const Components& components,
                                                   std::span<const HiddenFace> hidden,
                                                   uint32_t level, const SolidLeaves& solid) {
    // The solid leaves of a fragment are a body of their own: walls part them from the others.
    const auto bodyOf = [&](uint32_t leaf) {
        return 2 * components.at(level, leaf) + (solid.contains(leaf) ? 1 : 0);
    };
    const auto bodyOfTriangle = [&](uint32_t t) { return bodyOf(components.leaf[t]); };
    UnionFind outerFans = fansOf(topology.opposite, bodyOfTriangle);
    UnionFind hiddenFans = fansOf(
        sheet.opposite, [&](uint32_t t) { return bodyOfTriangle(sheet.triangles[t].parent); });
    // A hub is one vertex in each fragment that it belongs to.
    const auto firstHub = static_cast<uint32_t>(sheet.opposite.size());
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> hubs;
    const auto idOf = [&](CornerRef ref, uint32_t leaf) {
        if (ref.hidden == 0) return 2 * outerFans.find(ref.corner);
        if (!ref.isHub()) return 2 * hiddenFans.find(ref.corner) + 1;
        const std::pair key(uint32_t{ref.corner}, components.at(level, leaf));
        return 2 * (firstHub +
                    hubs.try_emplace(key, static_cast<uint32_t>(hubs.size())).first->second) +
               1;
    };
    std::vector<std::array<uint32_t, 3>> triangles;
    triangles.reserve(surface.triangles.size() + hidden.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        triangles.push_back({2 * outerFans.find(3 * t), 2 * outerFans.find(3 * t + 1),
                             2 * outerFans.find(3 * t + 2)});
    }
    for (const HiddenFace& face : hidden) {
        if (face.exposedFrom > level) continue;
        triangles.push_back({idOf(face.corners[0], face.leaf), idOf(face.corners[1], face.leaf),
                             idOf(face.corners[2], face.leaf)});
    }
    if (!hubs.empty()) {
        const auto count = static_cast<uint32_t>(hubs.size());
        separateHubs(2 * firstHub + 1, 2 * (firstHub + count) - 1, triangles);
    }
    return triangles;
}

}  // namespace sherd
