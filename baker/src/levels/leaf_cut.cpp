// SPDX-License-Identifier: MIT
#include "levels/leaf_cut.h"

#include <algorithm>
#include <span>
#include <utility>

#include "geometry/weld.h"
#include "levels/piece_cells.h"
#include "volume/prism_cut.h"
#include "volume/prism_vertices.h"

namespace sherd {
namespace {

/// groups: per cell; empty: each is one.
void setLabels(std::span<const uint32_t> groups, LeafCut& leaf) {
    if (leaf.pieces.pieces.empty()) return;
    leaf.labels.clear();
    for (const uint32_t cell : leaf.pieces.mainCell)
        leaf.labels.push_back(groups.empty() ? cell : groups[cell]);
}

/// Of the leaf's corners.
CutGridPoint middleOf(const LeafMesh& leaf, const CutGrid& grid) {
    glm::dvec3 middle(0);
    for (const glm::vec3& p : leaf.positions) middle += glm::dvec3(p);
    return grid.snap(middle / static_cast<double>(std::max<size_t>(leaf.positions.size(), 1)));
}

/// What is lowest there is the cell.
uint32_t cellAt(const CutGridPoint& at, const CellFunctions& functions) {
    uint32_t lowest = 0;
    for (uint32_t cell = 1; cell < functions.count(); ++cell)
        if (functions[cell].at(at) < functions[lowest].at(at)) lowest = cell;
    return lowest;
}

uint32_t cellAt(const PlanePoint& at, const PrismMap& map) {
    for (uint32_t cell = 0; cell < map.cells(); ++cell) {
        const auto sides = map.sides(cell);
        if (std::all_of(sides.begin(), sides.end(),
                        [&](const PrismMap::Side& side) { return map.sideOf(at, side) > 0; }))
            return cell;
    }
    return 0;  // the plane is full of cells
}

}  // namespace

std::vector<uint32_t> placesOf(const PieceModel& model) {
    std::vector<glm::vec3> distinct;
    std::vector<uint32_t> place = PositionWelder(distinct).add(model.hidden.positions);
    std::vector<uint32_t> first(distinct.size(), kNone);
    for (uint32_t v = 0; v < place.size(); ++v) {
        if (first[place[v]] == kNone) first[place[v]] = v;
        place[v] = first[place[v]];
    }
    return place;
}

std::vector<std::vector<uint32_t>> facesOfLeaves(const PieceModel& model) {
    std::vector<std::vector<uint32_t>> faces(model.components.leafCount);
    const auto outer = static_cast<uint32_t>(model.surface.triangles.size());
    for (uint32_t t = 0; t < outer; ++t) faces[model.components.leaf[t]].push_back(t);
    for (uint32_t f = 0; f < model.hidden.faces.size(); ++f)
        faces[model.hidden.faces[f].leaf].push_back(outer + f);
    return faces;
}

LeafMesh leafMesh(const PieceModel& model, const std::vector<uint32_t>& places,
                  const std::vector<uint32_t>& faces) {
    LeafMesh leaf;
    leaf.sources = faces;
    const auto outer = static_cast<uint32_t>(model.surface.triangles.size());
    leaf.triangles.reserve(faces.size());
    for (const uint32_t f : faces) {
        const auto& v = f < outer ? model.surface.triangles[f].v : model.hidden.faces[f - outer].v;
        leaf.triangles.push_back({places[v[0]], places[v[1]], places[v[2]]});
        for (const uint32_t corner : leaf.triangles.back()) leaf.vertices.push_back(corner);
    }
    std::sort(leaf.vertices.begin(), leaf.vertices.end());
    leaf.vertices.erase(std::unique(leaf.vertices.begin(), leaf.vertices.end()),
                        leaf.vertices.end());
    for (auto& t : leaf.triangles) {
        for (uint32_t& v : t) {
            const auto it = std::lower_bound(leaf.vertices.begin(), leaf.vertices.end(), v);
            v = static_cast<uint32_t>(it - leaf.vertices.begin());
        }
    }
    leaf.positions.reserve(leaf.vertices.size());
    for (const uint32_t v : leaf.vertices) leaf.positions.push_back(model.hidden.positions[v]);
    return leaf;
}

LeafCut cutLeaf(LeafMesh mesh, const VolumeCut& cut, uint64_t seed, const CutGrid& grid) {
    LeafCut result;
    result.mesh = std::move(mesh);
    Result<PieceCells> cells =
        pieceCells(cut, seed, result.mesh.positions, result.mesh.triangles, grid);
    if (!cells) {
        result.refusal = cells.error();
        return result;
    }
    result.cells = cells->pieces();
    Result<MeshCut> done =
        cutMesh(result.mesh.positions, result.mesh.triangles, grid, std::move(cells->functions));
    if (!done) {
        result.refusal = done.error();
        return result;
    }
    result.cut = std::move(*done);
    result.pieces = assemblePieces(result.cut, {.groups = cells->groups});
    setLabels(cells->groups, result);
    return result;
}

LeafCut cutLeafByShared(LeafMesh mesh, const PieceCells& cells, double thinnest,
                        const CutGrid& grid) {
    LeafCut result;
    result.mesh = std::move(mesh);
    result.shared = true;
    Result<MeshCut> done = cutMesh(result.mesh.positions, result.mesh.triangles, grid,
                                   cells.functions, {.shared = true});
    if (!done) {
        result.refusal = done.error();
        result.labels = {cells.groupOf(cellAt(middleOf(result.mesh, grid), cells.functions))};
        return result;
    }
    result.cut = std::move(*done);
    result.pieces = assemblePieces(result.cut, {.groups = cells.groups, .thinnest = thinnest});
    setLabels(cells.groups, result);
    return result;
}

LeafCut cutLeaf(LeafMesh mesh, const DrawnPrisms& prisms, const CutGrid& grid) {
    LeafCut result;
    result.mesh = std::move(mesh);
    Result<MeshCut> done =
        cutByPrisms(result.mesh.positions, result.mesh.triangles, grid, prisms.map, prisms.axis);
    if (!done) {
        result.refusal = done.error();
        return result;
    }
    result.cut = std::move(*done);
    result.pieces = assemblePieces(result.cut, {.groups = prisms.map.faces()});
    // A drawing is made for the object, not for each of its pieces: cells beside one are none of
    // its own.
    result.cells = static_cast<uint32_t>(result.pieces.pieces.size()) + result.pieces.slivers;
    setLabels(prisms.map.faces(), result);
    return result;
}

LeafCut cutLeafByShared(LeafMesh mesh, const DrawnPrisms& prisms, double thinnest,
                        const CutGrid& grid) {
    LeafCut result;
    result.mesh = std::move(mesh);
    result.shared = true;
    const std::vector<uint32_t>& faces = prisms.map.faces();
    Result<MeshCut> done = cutByPrisms(result.mesh.positions, result.mesh.triangles, grid,
                                       prisms.map, prisms.axis, {.shared = true});
    if (!done) {
        result.refusal = done.error();
        const PlanePoint at = planePoint(middleOf(result.mesh, grid), prisms.axis);
        result.labels = {faces[cellAt(at, prisms.map)]};
        return result;
    }
    result.cut = std::move(*done);
    result.pieces = assemblePieces(result.cut, {.groups = faces, .thinnest = thinnest});
    setLabels(faces, result);
    return result;
}

}  // namespace sherd
