// SPDX-License-Identifier: MIT
#include "solid/solid_leaves.h"

#include <algorithm>
#include <map>
#include <optional>

#include "geometry/closed_mesh.h"
#include "solid/filled_walls.h"
#include "solid/lumps.h"
#include "solid/solid_walls.h"
#include "solid/twin_leaves.h"
#include "surface/component_merging.h"

namespace sherd {
namespace {

CornerRef refOf(const OutlineVertex& v, bool low) {
    const uint32_t corner = v.cornerIn(low);
    if (corner == kNone) return {CornerRef::kFirstHub + v.hub, 1};
    return {corner, 0};
}

std::array<CornerRef, 3> cornersOf(const std::array<OutlineVertex, 3>& triangle, bool low) {
    std::array<CornerRef, 3> corners{};
    for (size_t k = 0; k < 3; ++k) corners[k] = refOf(triangle[low ? 2 - k : k], low);
    return corners;
}

/// The outer triangle that a wall's triangle hangs from, or the leaf's first.
uint32_t outerTriangle(const std::array<CornerRef, 3>& corners, uint32_t leaf,
                       const Components& components) {
    for (const CornerRef& ref : corners)
        if (!ref.isHub()) return ref.corner / 3;
    return static_cast<uint32_t>(std::find(components.leaf.begin(), components.leaf.end(), leaf) -
                                 components.leaf.begin());
}

/// The walls of chosen lumps. leafOf: per lump its leaf.
std::vector<HiddenFace> facesOf(const SolidWalls& solid, std::span<const uint8_t> chosen,
                                std::span<const uint32_t> leafOf, const Components& components) {
    std::vector<HiddenFace> faces;
    for (const SolidWall& wall : solid.walls) {
        if (leafOf[wall.low] == leafOf[wall.high]) continue;
        for (const bool low : {true, false}) {
            const uint32_t lump = low ? wall.low : wall.high;
            const uint32_t other = low ? wall.high : wall.low;
            if (chosen[lump] == 0) continue;
            HiddenFace face;
            face.leaf = leafOf[lump];
            face.neighbour = leafOf[other];
            face.wall = true;
            face.exposedFrom =
                chosen[other] != 0 ? components.separatedFrom(face.leaf, face.neighbour) : 1;
            for (const auto& triangle : wall.triangles) {
                face.corners = cornersOf(triangle, low);
                face.under = outerTriangle(face.corners, face.leaf, components);
                faces.push_back(face);
            }
        }
    }
    return faces;
}

/// Drops the leaves of fragments whose solid leaves are not closed together. Whether any were.
bool dropOpen(const SplitSurface& surface, const MeshTopology& topology,
              const Components& components, SolidLeaves& leaves) {
    std::vector<uint8_t> kept = leaves.solid;
    for (uint32_t level = 1; level <= components.levels; ++level) {
        const auto triangles =
            levelTopology(surface, topology, {}, components, leaves.faces, level, leaves);
        std::map<uint32_t, std::vector<std::array<uint32_t, 3>>> bodies;
        size_t next = 0;
        const auto take = [&](uint32_t leaf) {
            if (leaves.contains(leaf))
                bodies[components.at(level, leaf)].push_back(triangles[next]);
            ++next;
        };
        for (const uint32_t leaf : components.leaf) take(leaf);
        for (const HiddenFace& face : leaves.faces)
            if (face.exposedFrom <= level) take(face.leaf);
        for (const auto& [fragment, body] : bodies) {
            if (proveByIds(body).manifold()) continue;
            for (uint32_t leaf = 0; leaf < kept.size(); ++leaf)
                if (components.at(level, leaf) == fragment) kept[leaf] = 0;
        }
    }
    const bool changed = kept != leaves.solid;
    leaves.solid = std::move(kept);
    return changed;
}

double areaOf(const SolidWalls& walls, std::span<const double> areas) {
    double sum = 0;
    for (size_t leaf = 0; leaf < areas.size(); ++leaf)
        if (walls.solid[leaf] != 0) sum += areas[leaf];
    return sum;
}

bool closesAll(const SolidWalls& walls) {
    return std::find(walls.solid.begin(), walls.solid.end(), 0) == walls.solid.end();
}

/// Walls that lead straight from line to line, of several kinds those that close more.
class StraightWalls {
  public:
    StraightWalls(const CutSurface& cut, const Components& pieces)
        : cut_(cut),
          pieces_(pieces),
          areas_(leafAreas(cut.surface, pieces)),
          space_(CellSpace::of(cut, pieces)),
          best_(build(space_ ? &*space_ : nullptr, HubChoice::near)) {
        if (space_ && !closesAll(best_)) offer(build(nullptr, HubChoice::near));
    }

    /// What is tried last.
    void tryCentres() {
        if (!closesAll(best_)) offer(build(nullptr, HubChoice::centre));
    }
    const SolidWalls& best() const { return best_; }
    SolidWalls take() { return std::move(best_); }

  private:
    SolidWalls build(const CellSpace* known, HubChoice choice) const {
        return solidWalls(cut_.surface, cut_.topology, pieces_.leaf, pieces_.leafCount, known,
                          choice);
    }
    void offer(SolidWalls other) {
        if (areaOf(other, areas_) > areaOf(best_, areas_)) best_ = std::move(other);
    }

    const CutSurface& cut_;
    const Components& pieces_;
    std::vector<double> areas_;
    std::optional<CellSpace> space_;
    SolidWalls best_;
};

/// What is known per triangle, for the triangles of a surface that is divided further.
template <class Value>
void divide(const DividedSurface& divided, std::vector<Value>& values) {
    std::vector<Value> parts;
    parts.reserve(divided.parent.size());
    for (const uint32_t parent : divided.parent) parts.push_back(values[parent]);
    values = std::move(parts);
}

/// Walls through a solid of any shape, if they close more than `walls` do; the surface is divided
/// further for them.
std::optional<SolidWalls> fillInside(const SolidWalls& walls, CutSurface& cut,
                                     Components& components, Components& pieces) {
    std::optional<FilledWalls> filled = filledWalls(cut.surface, pieces);
    const std::vector<double> areas = leafAreas(cut.surface, pieces);
    if (!filled || !(areaOf(filled->walls, areas) > areaOf(walls, areas))) return std::nullopt;
    const DividedSurface& divided = filled->divided;
    MeshTopology topology =
        buildTopology(divided.surface.positions, vertexTriangles(divided.surface));
    const auto flaws = [](const MeshTopology& t) {
        return t.boundaryEdges + t.nonManifoldEdges + t.pinchedEdges;
    };
    if (flaws(topology) > flaws(cut.topology)) return std::nullopt;
    for (CellLevel& level : cut.cells) divide(divided, level.domain);
    divide(divided, components.leaf);
    divide(divided, pieces.leaf);
    cut.surface = std::move(filled->divided.surface);
    cut.topology = std::move(topology);
    return std::move(filled->walls);
}

SolidWalls bestWalls(bool mayDivide, CutSurface& cut, Components& components, Components& pieces) {
    StraightWalls straight(cut, pieces);
    if (mayDivide && !closesAll(straight.best())) {
        if (auto filled = fillInside(straight.best(), cut, components, pieces))
            return std::move(*filled);
    }
    straight.tryCentres();
    return straight.take();
}

}  // namespace

SolidLeaves findSolidLeaves(CutSurface& cut, bool carried, bool mayDivide, Components& components) {
    const std::vector<uint32_t> twins = twinLeaves(
        cut.surface, cut.topology, components, FarSide(cut.surface, cut.topology),
        [&cut](uint32_t level) { return !cut.hasCells(level); }, carried);
    std::vector<uint32_t> pieceOf;  // per leaf as it was
    Components pieces = uniteLeaves(components, twins, pieceOf);
    SolidWalls walls = bestWalls(mayDivide, cut, components, pieces);
    std::vector<uint8_t> chosen = walls.solid;  // per piece
    const bool sited = !walls.filled && CellSpace::of(cut, pieces).has_value();
    const Lumps lumps = splitLumps(cut.surface, cut.topology, pieces, cut.groups, sited, walls);
    for (;;) {
        // Twins that are not solid stay apart.
        std::vector<uint32_t> group = twins;
        for (uint32_t leaf = 0; leaf < group.size(); ++leaf)
            if (chosen[pieceOf[leaf]] == 0) group[leaf] = leaf;
        std::vector<uint32_t> newLeaf;
        Components result = uniteLeaves(components, group, newLeaf);
        SolidLeaves leaves;
        leaves.solid.assign(result.leafCount, 0);
        leaves.hubs = walls.hubs;
        std::vector<uint32_t> leafOfPiece(pieces.leafCount, kNone);
        for (uint32_t leaf = 0; leaf < group.size(); ++leaf) {
            if (leafOfPiece[pieceOf[leaf]] == kNone) leafOfPiece[pieceOf[leaf]] = newLeaf[leaf];
            leaves.solid[newLeaf[leaf]] = chosen[pieceOf[leaf]];
        }
        std::vector<uint32_t> leafOf;
        std::vector<uint8_t> chosenLumps;
        for (uint32_t lump = 0; lump < lumps.pieceOf.size(); ++lump) {
            const uint32_t own = lumps.pieceOf[lump], target = lumps.target[lump];
            const bool moves = chosen[own] != 0 && chosen[target] != 0;
            leafOf.push_back(leafOfPiece[moves ? target : own]);
            chosenLumps.push_back(chosen[own]);
        }
        for (uint32_t t = 0; t < result.leaf.size(); ++t) {
            const uint32_t lump = lumps.ofTriangle[t];
            if (lumps.target[lump] != lumps.pieceOf[lump] && chosenLumps[lump] != 0)
                result.leaf[t] = leafOf[lump];
        }
        leaves.faces = facesOf(walls, chosenLumps, leafOf, result);
        if (!dropOpen(cut.surface, cut.topology, result, leaves)) {
            leaves.strays = lumps.strays;
            components = std::move(result);
            return leaves;
        }
        for (uint32_t leaf = 0; leaf < group.size(); ++leaf)
            chosen[pieceOf[leaf]] = std::min(chosen[pieceOf[leaf]], leaves.solid[newLeaf[leaf]]);
    }
}

}  // namespace sherd
