// SPDX-License-Identifier: MIT
#include "levels/leaf_cut.h"

#include <algorithm>
#include <utility>

#include "geometry/weld.h"
#include "levels/piece_cells.h"

namespace sherd {
namespace {

void setLabels(const PieceCells& cells, LeafCut& leaf) {
    if (leaf.pieces.pieces.empty()) return;
    leaf.labels.clear();
    for (const uint32_t cell : leaf.pieces.mainCell) leaf.labels.push_back(cells.groupOf(cell));
}

/// Of the leaf's corners: what is lowest there is the cell.
uint32_t cellAtMiddle(const LeafMesh& leaf, const CellFunctions& functions, const CutGrid& grid) {
    glm::dvec3 middle(0);
    for (const glm::vec3& p : leaf.positions) middle += glm::dvec3(p);
    const CutGridPoint at =
        grid.snap(middle / static_cast<double>(std::max<size_t>(leaf.positions.size(), 1)));
    uint32_t lowest = 0;
    for (uint32_t cell = 1; cell < functions.count(); ++cell)
        if (functions[cell].at(at) < functions[lowest].at(at)) lowest = cell;
    return lowest;
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
    setLabels(*cells, result);
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
        result.labels = {cells.groupOf(cellAtMiddle(result.mesh, cells.functions, grid))};
        return result;
    }
    result.cut = std::move(*done);
    result.pieces = assemblePieces(result.cut, {.groups = cells.groups, .thinnest = thinnest});
    setLabels(cells, result);
    return result;
}

}  // namespace sherd
