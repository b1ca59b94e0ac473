// SPDX-License-Identifier: MIT
#include "solid/solid_walls.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <unordered_set>

#include "geometry/closed_mesh.h"
#include "geometry/triangle.h"
#include "solid/cell_skeleton.h"
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
          graph_(borderGraph(surface, topology, piece, pieceCount)),
          skeleton_(graph_.nodes.size()) {}

    SolidWalls run(const CellSpace* space, HubChoice choice) {
        findEdges();
        if (space != nullptr) followCells(surface_, *space, graph_, skeleton_);
        completeSkeleton(surface_.positions, graph_, choice, skeleton_);
        bendAroundEdges();
        WallOutlines outlines = wallOutlines(surface_, topology_, graph_, skeleton_, space);
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
        for (size_t l = 0, count = skeleton_.lines.size(); l < count; ++l) {
            const uint32_t a = skeleton_.lines[l].from, b = skeleton_.lines[l].to;
            if (skeleton_.isHub(a) || skeleton_.isHub(b)) continue;
            const uint32_t va = graph_.nodes[a].vertex, vb = graph_.nodes[b].vertex;
            if (!edges_.contains(edgeKey(va, vb))) continue;
            const uint32_t hub = skeleton_.addHub(
                (glm::dvec3(surface_.positions[va]) + glm::dvec3(surface_.positions[vb])) * 0.5);
            skeleton_.lines[l].to = hub;
            skeleton_.linesAt[hub].push_back(static_cast<uint32_t>(l));
            skeleton_.linesAt[b].clear();
            skeleton_.addLine(hub, b, std::vector<uint32_t>(skeleton_.lines[l].pieces));
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
        if (a.hub == kNone && b.hub == kNone &&
            (a.vertex == b.vertex || edges_.contains(edgeKey(a.vertex, b.vertex))))
            return false;
        const std::vector<uint32_t> x = piecesAt(a), y = piecesAt(b);
        std::vector<uint32_t> common;
        std::set_intersection(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(common));
        return common.size() < 3;
    }

    /// The pieces that meet in a vertex, ascending; none unless it is a node or a hub.
    std::vector<uint32_t> piecesAt(const OutlineVertex& v) const {
        const uint32_t end =
            v.hub != kNone ? skeleton_.nodes + v.hub : graph_.nodeOfVertex[v.vertex];
        std::vector<uint32_t> pieces;
        if (end == kNone) return pieces;
        if (v.hub != kNone) {
            for (const uint32_t line : skeleton_.linesAt[end]) {
                const auto& some = skeleton_.lines[line].pieces;
                pieces.insert(pieces.end(), some.begin(), some.end());
            }
        } else {
            pieces = piecesAround(graph_.nodes[end], false);
        }
        std::sort(pieces.begin(), pieces.end());
        pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
        return pieces;
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
            if (crossings.crosses(wall, skeleton_.hubs) || crossings.leaves(wall, skeleton_.hubs))
                continue;
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
                      std::span<const uint32_t> piece, uint32_t pieceCount, const CellSpace* space,
                      HubChoice choice) {
    return WallBuilder(surface, topology, piece, pieceCount).run(space, choice);
}

}  // namespace sherd
