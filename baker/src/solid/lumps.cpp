// SPDX-License-Identifier: MIT
#include "solid/lumps.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "geometry/compact_labels.h"
#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

class LumpSplitter {
  public:
    LumpSplitter(const SplitSurface& surface, const MeshTopology& topology,
                 const Components& pieces, SolidWalls& walls)
        : surface_(surface), pieces_(pieces), walls_(walls), bodies_(countElements()) {
        for (uint32_t h = 0; h < topology.opposite.size(); ++h) {
            const uint32_t o = topology.opposite[h];
            if (o != kNone && o < h && pieces.leaf[h / 3] == pieces.leaf[o / 3])
                bodies_.unite(h / 3, o / 3);
        }
        for (const SolidWall& wall : walls.walls) {
            for (const bool low : {true, false}) {
                const uint32_t first = elementOf(wall.triangles[0][0], wall, low);
                for (const auto& t : wall.triangles)
                    for (const OutlineVertex& v : t) bodies_.unite(first, elementOf(v, wall, low));
            }
        }
    }

    Lumps run() {
        Lumps lumps;
        std::vector<uint32_t> root;
        for (uint32_t t = 0; t < surface_.triangles.size(); ++t) root.push_back(bodies_.find(t));
        uint32_t count = 0;
        lumps.ofTriangle = compactLabels(root, count);
        lumps.pieceOf.resize(count);
        std::map<uint32_t, uint32_t> lumpOf;
        for (uint32_t t = 0; t < root.size(); ++t) {
            lumpOf[root[t]] = lumps.ofTriangle[t];
            lumps.pieceOf[lumps.ofTriangle[t]] = pieces_.leaf[t];
        }
        for (SolidWall& wall : walls_.walls) {
            const uint32_t low = bodies_.find(elementOf(wall.triangles[0][0], wall, true));
            const uint32_t high = bodies_.find(elementOf(wall.triangles[0][0], wall, false));
            wall.low = lumpOf.at(low);
            wall.high = lumpOf.at(high);
        }
        std::vector<uint8_t> solid;
        for (const uint32_t piece : lumps.pieceOf) solid.push_back(walls_.solid[piece]);
        walls_.solid = std::move(solid);
        lumps.target = lumps.pieceOf;
        return lumps;
    }

  private:
    /// Triangles first, then hubs once for each piece that has them.
    size_t countElements() {
        auto next = static_cast<uint32_t>(surface_.triangles.size());
        for (const SolidWall& wall : walls_.walls) {
            for (const auto& t : wall.triangles) {
                for (const OutlineVertex& v : t) {
                    for (const uint32_t piece : {wall.low, wall.high}) {
                        if (v.hub != kNone && hubs_.try_emplace({v.hub, piece}, next).second)
                            ++next;
                    }
                }
            }
        }
        return next;
    }
    uint32_t elementOf(const OutlineVertex& v, const SolidWall& wall, bool low) const {
        const uint32_t corner = v.cornerIn(low);
        return corner != kNone ? corner / 3 : hubs_.at({v.hub, low ? wall.low : wall.high});
    }

    const SplitSurface& surface_;
    const Components& pieces_;
    SolidWalls& walls_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> hubs_;  ///< hub and piece: the element
    UnionFind bodies_;
};

double areaOf(const SplitSurface& surface, const SolidWalls& walls, const SolidWall& wall) {
    const auto at = [&](const OutlineVertex& v) {
        return glm::dvec3(v.hub != kNone ? walls.hubs[v.hub] : surface.positions[v.vertex]);
    };
    double area = 0;
    for (const auto& t : wall.triangles)
        area += glm::length(glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]))) / 2;
    return area;
}

/// Which lumps are not the largest of their piece in their part of the mesh.
std::vector<uint8_t> findStrays(const SplitSurface& surface, const PartGroups& groups,
                                const SolidWalls& walls, const Lumps& lumps) {
    std::vector<double> area(lumps.pieceOf.size(), 0);
    std::vector<uint32_t> part(lumps.pieceOf.size(), 0);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const uint32_t lump = lumps.ofTriangle[t];
        area[lump] += triangleArea(surface.positions, surface.triangles[t].v);
        part[lump] = groups.part[surface.triangles[t].source];
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> largest;  // piece, part
    for (uint32_t lump = 0; lump < area.size(); ++lump) {
        uint32_t& best = largest.try_emplace({lumps.pieceOf[lump], part[lump]}, lump).first->second;
        if (area[lump] > area[best]) best = lump;
    }
    std::vector<uint8_t> stray(area.size(), 0);
    for (uint32_t lump = 0; lump < area.size(); ++lump) {
        const bool isLargest = largest.at({lumps.pieceOf[lump], part[lump]}) == lump;
        stray[lump] = !isLargest && walls.solid[lump] != 0 ? 1 : 0;
    }
    return stray;
}

Lumps wholePieces(const Components& pieces) {
    Lumps lumps;
    lumps.ofTriangle = pieces.leaf;
    lumps.pieceOf.resize(pieces.leafCount);
    std::iota(lumps.pieceOf.begin(), lumps.pieceOf.end(), 0U);
    lumps.target = lumps.pieceOf;
    return lumps;
}

}  // namespace

Lumps splitLumps(const SplitSurface& surface, const MeshTopology& topology,
                 const Components& pieces, const PartGroups& groups, bool judged,
                 SolidWalls& walls) {
    if (!judged) return wholePieces(pieces);
    Lumps lumps = LumpSplitter(surface, topology, pieces, walls).run();
    std::vector<uint8_t> stray = findStrays(surface, groups, walls, lumps);
    const auto parentOf = [&](uint32_t lump) {
        return pieces.at(pieces.levels - 1, lumps.pieceOf[lump]);
    };
    std::map<std::pair<uint32_t, uint32_t>, double> border;  // stray, neighbour
    for (const SolidWall& wall : walls.walls) {
        if (walls.solid[wall.low] == 0 || walls.solid[wall.high] == 0) continue;
        if (parentOf(wall.low) != parentOf(wall.high)) continue;
        const double area = areaOf(surface, walls, wall);
        border[{wall.low, wall.high}] += area;
        border[{wall.high, wall.low}] += area;
    }
    // Strays among strays follow those that have found a place.
    for (bool changed = true; changed;) {
        changed = false;
        std::map<uint32_t, std::pair<double, uint32_t>> best;
        for (const auto& [pair, area] : border) {
            if (stray[pair.first] == 0 || stray[pair.second] != 0) continue;
            const auto [it, isNew] = best.try_emplace(pair.first, area, pair.second);
            if (!isNew && area > it->second.first) it->second = {area, pair.second};
        }
        for (const auto& [lump, neighbour] : best) {
            lumps.target[lump] = lumps.target[neighbour.second];
            stray[lump] = 0;
            ++lumps.strays;
            changed = true;
        }
    }
    return lumps;
}

}  // namespace sherd
