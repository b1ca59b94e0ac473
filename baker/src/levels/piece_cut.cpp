// SPDX-License-Identifier: MIT
#include "levels/piece_cut.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "levels/piece_cells.h"
#include "parallel/parallel_for.h"
#include "volume/coplanar_faces.h"

namespace sherd {
namespace {

/// Walls that show on both sides within the piece are none of it.
void dropInnerWalls(uint32_t outerFaces, LeafMesh& piece) {
    using Triangle = std::array<uint32_t, 3>;
    std::map<Triangle, std::vector<uint32_t>> open;  // from the lowest corner on: hidden faces
    std::vector<uint8_t> dropped(piece.triangles.size(), 0);
    for (uint32_t t = 0; t < piece.triangles.size(); ++t) {
        if (piece.sources[t] < outerFaces) continue;
        Triangle v = piece.triangles[t];
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        const auto other = open.find({v[0], v[2], v[1]});
        if (other == open.end() || other->second.empty()) {
            open[v].push_back(t);
            continue;
        }
        dropped[t] = dropped[other->second.back()] = 1;
        other->second.pop_back();
    }
    size_t kept = 0;
    for (size_t t = 0; t < piece.triangles.size(); ++t) {
        if (dropped[t] != 0) continue;
        piece.triangles[kept] = piece.triangles[t];
        piece.sources[kept++] = piece.sources[t];
    }
    piece.triangles.resize(kept);
    piece.sources.resize(kept);
}

class PieceCutter {
  public:
    PieceCutter(const VolumeCut& cut, const DrawnPrisms* prisms, const CutGrid& grid,
                const PieceModel& model)
        : cut_(cut),
          prisms_(prisms),
          grid_(grid),
          model_(model),
          faces_(facesOfLeaves(model)),
          places_(placesOf(model)) {
        for (std::vector<uint32_t>& leaves : leavesOfPieces(model.components))
            result_.pieces.push_back({std::move(leaves), 0, 0, 0, {}});
        result_.leaves.resize(faces_.size());
    }

    Result<PieceCuts> run(unsigned threads, const std::vector<PieceName>& names) {
        const Result<std::vector<uint8_t>> chosen =
            choosePieces(cut_.only, model_, names, facesOfPieces());
        if (!chosen) return tl::unexpected(chosen.error());
        if (prisms_ != nullptr)
            cutByDrawing(threads, *chosen);
        else
            cutByCells(threads, *chosen);
        return std::move(result_);
    }

  private:
    void cutByCells(unsigned threads, const std::vector<uint8_t>& chosen) {
        std::vector<std::optional<PieceCells>> cells(result_.pieces.size());
        parallelRuns(cells.size(), 1, threads, [&](size_t first, size_t last) {
            for (size_t p = first; p < last; ++p)
                if (chosen[p] != 0) begin(result_.pieces[p], cells[p]);
        });
        const std::vector<uint32_t> pieceOf = piecesOfLeaves();
        parallelRuns(faces_.size(), 1, threads, [&](size_t first, size_t last) {
            for (size_t leaf = first; leaf < last; ++leaf) {
                if (!cells[pieceOf[leaf]]) continue;
                result_.leaves[leaf] = cutLeafByShared(meshOf(leaf), *cells[pieceOf[leaf]],
                                                       kCoplanarShift * grid_.extent(), grid_);
            }
        });
    }

    /// A drawing lies where it does, whatever pieces are there.
    void cutByDrawing(unsigned threads, const std::vector<uint8_t>& chosen) {
        const std::vector<uint32_t> pieceOf = piecesOfLeaves();
        parallelRuns(faces_.size(), 1, threads, [&](size_t first, size_t last) {
            for (size_t leaf = first; leaf < last; ++leaf) {
                if (chosen[pieceOf[leaf]] == 0) continue;
                result_.leaves[leaf] = result_.pieces[pieceOf[leaf]].isShared()
                                           ? cutLeafByShared(meshOf(leaf), *prisms_,
                                                             kCoplanarShift * grid_.extent(), grid_)
                                           : cutLeaf(meshOf(leaf), *prisms_, grid_);
            }
        });
        for (uint32_t p = 0; p < result_.pieces.size(); ++p) {
            if (chosen[p] == 0 || !result_.pieces[p].isShared()) continue;
            std::set<uint32_t> labels;
            for (const uint32_t leaf : result_.pieces[p].leaves)
                labels.insert(result_.leaves[leaf].labels.begin(),
                              result_.leaves[leaf].labels.end());
            result_.pieces[p].cells = static_cast<uint32_t>(labels.size());
        }
    }

    std::vector<uint32_t> piecesOfLeaves() const {
        std::vector<uint32_t> pieceOf(faces_.size());
        for (uint32_t p = 0; p < result_.pieces.size(); ++p)
            for (const uint32_t leaf : result_.pieces[p].leaves) pieceOf[leaf] = p;
        return pieceOf;
    }

    LeafMesh meshOf(size_t leaf) const { return leafMesh(model_, places_, faces_[leaf]); }

    std::vector<std::vector<uint32_t>> facesOfPieces() const {
        std::vector<std::vector<uint32_t>> faces;
        for (const PieceCut& piece : result_.pieces) faces.push_back(facesOf(piece));
        return faces;
    }

    std::vector<uint32_t> facesOf(const PieceCut& piece) const {
        std::vector<uint32_t> faces;
        for (const uint32_t leaf : piece.leaves)
            faces.insert(faces.end(), faces_[leaf].begin(), faces_[leaf].end());
        std::sort(faces.begin(), faces.end());
        return faces;
    }

    /// Cuts a piece of one leaf; finds the cells of one of several.
    void begin(PieceCut& piece, std::optional<PieceCells>& cells) {
        // Seeds of neighbours are far apart.
        const uint64_t seed = cut_.seed + piece.leaves[0] * 0x9E3779B97F4A7C15ULL;
        LeafMesh mesh = leafMesh(model_, places_, facesOf(piece));
        if (!piece.isShared()) {
            result_.leaves[piece.leaves[0]] = cutLeaf(std::move(mesh), cut_, seed, grid_);
            return;
        }
        dropInnerWalls(static_cast<uint32_t>(model_.surface.triangles.size()), mesh);
        Result<PieceCells> found = pieceCells(cut_, seed, mesh.positions, mesh.triangles, grid_);
        if (!found) {
            piece.refusal = found.error();
            return;
        }
        Result<SettledCells> settled =
            settleCells(mesh.positions, mesh.triangles, grid_, std::move(found->functions));
        if (!settled) {
            piece.refusal = settled.error();
            return;
        }
        found->functions = std::move(settled->functions);
        piece.cells = found->pieces();
        piece.movedPlanes = settled->moved;
        piece.opposedPlanes = settled->opposed;
        cells = std::move(*found);
    }

    const VolumeCut& cut_;
    const DrawnPrisms* prisms_;
    const CutGrid& grid_;
    const PieceModel& model_;
    std::vector<std::vector<uint32_t>> faces_;  ///< per leaf
    std::vector<uint32_t> places_;
    PieceCuts result_;
};

}  // namespace

std::vector<std::vector<uint32_t>> leavesOfPieces(const Components& components) {
    std::vector<std::vector<uint32_t>> leaves(
        components.levels == 0 ? 1 : components.count[components.levels - 1]);
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
        leaves[components.at(components.levels, leaf)].push_back(leaf);
    return leaves;
}

Result<PieceCuts> cutPieces(const VolumeCut& cut, const DrawnPrisms* prisms, unsigned threads,
                            const std::vector<PieceName>& names, const CutGrid& grid,
                            const PieceModel& model) {
    return PieceCutter(cut, prisms, grid, model).run(threads, names);
}

}  // namespace sherd
