// SPDX-License-Identifier: MIT
#include "solid/solid_walls.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <unordered_set>

#include "geometry/closed_mesh.h"
#include "geometry/triangle.h"
#include "solid/outline_joining.h"
#include "solid/wall_crossings.h"

namespace sherd {
namespace {

uint64_t edgeKey(uint32_t a, uint32_t b) {
    return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

class WallBuilder {
  public:
    WallBuilder(const SplitSurface& surface, const MeshTopology& topology,
                std::span<const uint32_t> piece, uint32_t pieceCount)
        : surface_(surface),
          topology_(topology),
          piece_(piece),
          pieceCount_(pieceCount),
          graph_(borderGraph(surface, topology, piece, pieceCount)) {}

    SolidWalls run(HubChoice choice) {
        findEdges();
        skeleton_ = findSkeleton(surface_.positions, graph_, choice);
        bendAroundEdges();
        WallOutlines outlines = wallOutlines(surface_, topology_, graph_, skeleton_);
        broken_ = std::move(outlines.broken);
        std::vector<WallPolygon> polygons;
        for (WallOutline& outline : outlines.walls)
            polygons.push_back(withCorners(std::move(outline)));
        joinOutlines(
            polygons,
            [this](const OutlineVertex& a, const OutlineVertex& b) { return allowed(a, b); },
            broken_);
        const WallCrossings crossings(surface_);
        for (const WallPolygon& polygon : polygons) fill(polygon, crossings);
        SolidWalls result{std::move(walls_), std::move(skeleton_.hubs), {}};
        crossings.markAmong(result.walls, result.hubs, broken_);
        markHollow(result);
        for (const uint8_t broken : broken_) result.solid.push_back(broken == 0 ? 1 : 0);
        return result;
    }

  private:
    /// Edges of the surface between vertices on borders: no wall may use them inside a piece, or
    /// it would touch the surface there.
    void findEdges() {
        std::vector<uint8_t> onBorder(surface_.positions.size(), 0);
        const auto start = [this](uint32_t h) { return surface_.triangles[h / 3].v[h % 3]; };
        for (const BorderArc& arc : graph_.arcs)
            for (const uint32_t h : arc.halfEdges)
                onBorder[start(h)] = onBorder[start(nextCorner(h))] = 1;
        normals_.assign(surface_.positions.size(), glm::dvec3(0.0));
        for (uint32_t h = 0; h < 3 * surface_.triangles.size(); ++h) {
            const uint32_t v = start(h);
            if (onBorder[v] == 0) continue;
            const auto& t = surface_.triangles[h / 3].v;
            const glm::dvec3 a = surface_.positions[t[0]];
            normals_[v] += glm::cross(glm::dvec3(surface_.positions[t[1]]) - a,
                                      glm::dvec3(surface_.positions[t[2]]) - a);
            if (onBorder[start(nextCorner(h))] != 0)
                edges_.insert(edgeKey(v, start(nextCorner(h))));
        }
    }

    /// A node whose partner is its neighbour on the surface: the way between them through the solid
    /// gets a hub of its own, to be told from the edge.
    void bendAroundEdges() {
        for (uint32_t a = 0; a < graph_.nodes.size(); ++a) {
            const uint32_t b = skeleton_.partner[a];
            if (b == kNone || b < a) continue;
            const uint32_t va = graph_.nodes[a].vertex, vb = graph_.nodes[b].vertex;
            if (!edges_.contains(edgeKey(va, vb))) continue;
            skeleton_.partner[a] = skeleton_.partner[b] = kNone;
            skeleton_.hubOf[a] = skeleton_.hubOf[b] = static_cast<uint32_t>(skeleton_.hubs.size());
            skeleton_.hubs.emplace_back(
                (glm::dvec3(surface_.positions[va]) + glm::dvec3(surface_.positions[vb])) * 0.5);
        }
    }

    glm::dvec3 positionOf(const OutlineVertex& v) const {
        return v.hub != kNone ? skeleton_.hubs[v.hub] : surface_.positions[v.vertex];
    }

    WallPolygon withCorners(WallOutline outline) const {
        WallPolygon polygon;
        for (const OutlineVertex& v : outline.vertices) {
            PolygonCorner corner{positionOf(v), glm::dvec3(0.0), 2 * v.arc};
            if (v.vertex != kNone) {
                const double length = glm::length(normals_[v.vertex]);
                if (length > 0) corner.inwards = -normals_[v.vertex] / length;
            } else {
                corner.side = 2 * v.hub + 1;
            }
            polygon.corners.push_back(corner);
        }
        polygon.outline = std::move(outline);
        splitSides(polygon.corners);
        return polygon;
    }

    /// A line that leads over a rim lies on both sides of a wall: up to the rim its corners look
    /// towards where it ends, and from there on back to where it began.
    static void splitSides(std::vector<PolygonCorner>& corners) {
        const auto first = corners.front().side;
        const auto sameSide = [first](const PolygonCorner& c) { return c.side == first; };
        const auto end = std::find_if_not(corners.begin(), corners.end(), sameSide);
        if (!std::all_of(end, corners.end(),
                         [](const PolygonCorner& c) { return c.inwards == glm::dvec3(0.0); }))
            return;
        const glm::dvec3 across = std::prev(end)->position - corners.front().position;
        double sum = 0;
        double most = 0;
        auto rim = corners.begin();
        for (auto it = corners.begin(); it != end; ++it) {
            sum += glm::dot(it->inwards, across);
            if (!(sum > most)) continue;
            most = sum;
            rim = it;
        }
        for (auto it = rim; it != end; ++it) it->side = kNone;
    }

    /// Edges inside a wall must be its own: none of the surface, and none that another wall of the
    /// same piece could choose as well.
    bool allowed(const OutlineVertex& a, const OutlineVertex& b) const {
        if (a.hub != kNone && b.hub != kNone) return false;
        if (a.hub != kNone || b.hub != kNone) {
            const OutlineVertex& hub = a.hub != kNone ? a : b;
            const uint32_t node = graph_.nodeOfVertex[a.hub != kNone ? b.vertex : a.vertex];
            return node == kNone || skeleton_.hubOf[node] != hub.hub;
        }
        if (a.vertex == b.vertex || edges_.contains(edgeKey(a.vertex, b.vertex))) return false;
        const uint32_t na = graph_.nodeOfVertex[a.vertex], nb = graph_.nodeOfVertex[b.vertex];
        if (na == kNone || nb == kNone) return true;
        size_t common = 0;
        for (const BorderNode::Spoke& x : graph_.nodes[na].spokes)
            for (const BorderNode::Spoke& y : graph_.nodes[nb].spokes)
                common += x.after == y.after ? 1 : 0;
        return common < 3;
    }

    /// As even as may be; where that crosses the surface, steeper, or ruled from side to side.
    void fill(const WallPolygon& polygon, const WallCrossings& crossings) {
        const std::vector<OutlineVertex>& v = polygon.outline.vertices;
        for (const FillingStyle style :
             {FillingStyle::even, FillingStyle::steep, FillingStyle::ruled}) {
            const auto triangles = fillPolygon(polygon.corners, style, [&](uint32_t i, uint32_t j) {
                return allowed(v[i], v[j]);
            });
            if (!triangles) break;
            SolidWall wall{polygon.outline.low, polygon.outline.high, {}};
            for (const auto& t : *triangles) wall.triangles.push_back({v[t[0]], v[t[1]], v[t[2]]});
            if (crossings.crosses(wall, skeleton_.hubs)) continue;
            walls_.push_back(std::move(wall));
            return;
        }
        broken_[polygon.outline.low] = broken_[polygon.outline.high] = 1;
    }

    /// Pieces without a positive volume.
    void markHollow(const SolidWalls& solid) {
        std::vector<double> volume(pieceCount_, 0);
        const glm::dvec3 origin = surface_.positions[0];
        const auto six = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            return glm::dot(a - origin, glm::cross(b - origin, c - origin));
        };
        for (size_t t = 0; t < surface_.triangles.size(); ++t) {
            const auto& v = surface_.triangles[t].v;
            volume[piece_[t]] +=
                six(surface_.positions[v[0]], surface_.positions[v[1]], surface_.positions[v[2]]);
        }
        const auto at = [&](const OutlineVertex& v) {
            return glm::dvec3(v.hub != kNone ? solid.hubs[v.hub] : surface_.positions[v.vertex]);
        };
        for (const SolidWall& wall : solid.walls) {
            for (const auto& t : wall.triangles) {
                const double share = six(at(t[0]), at(t[1]), at(t[2]));
                volume[wall.high] += share;
                volume[wall.low] -= share;
            }
        }
        for (uint32_t p = 0; p < pieceCount_; ++p)
            if (!(volume[p] > 0)) broken_[p] = 1;
    }

    const SplitSurface& surface_;
    const MeshTopology& topology_;
    std::span<const uint32_t> piece_;
    uint32_t pieceCount_;
    BorderGraph graph_;
    Skeleton skeleton_;
    std::vector<glm::dvec3> normals_;  ///< of vertices on borders, not unit
    std::unordered_set<uint64_t> edges_;
    std::vector<SolidWall> walls_;
    std::vector<uint8_t> broken_;  ///< per piece
};

}  // namespace

SolidWalls solidWalls(const SplitSurface& surface, const MeshTopology& topology,
                      std::span<const uint32_t> piece, uint32_t pieceCount, HubChoice choice) {
    return WallBuilder(surface, topology, piece, pieceCount).run(choice);
}

}  // namespace sherd
