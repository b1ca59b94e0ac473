// SPDX-License-Identifier: MIT
#include "levels/volume_level.h"

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/closed_mesh.h"
#include "geometry/union_find.h"
#include "levels/piece_cut.h"
#include "levels/piece_joining.h"
#include "message_text.h"
#include "sherd/baker/pattern.h"

namespace sherd {
namespace {

/// A scene's places in the object's frame, as its pieces are.
VolumeCut inObjectFrame(VolumeCut cut, const SurfaceMesh& mesh) {
    for (std::vector<glm::dvec3>* places : {&cut.around, &cut.points})
        for (glm::dvec3& p : *places) p = toObjectFrame(mesh.restPose, p);
    cut.only = inObjectFrame(std::move(cut.only), mesh);
    if (cut.centre) cut.centre = toObjectFrame(mesh.restPose, *cut.centre);
    return cut;
}

void tellDrawing(const VolumeCut& cut, const DrawnPrisms& prisms, BakedObjectReport& report) {
    for (const std::string& warning : prisms.warnings)
        report.findings.push_back({"map", warning, cut.text, 1});
    const auto find = [&](const char* code, uint32_t count, const std::string& message) {
        if (count > 0) report.findings.push_back({code, message, cut.text, count});
    };
    find("idle-lines", prisms.map.idleEdges(),
         "lines of the drawing have one and the same face on both sides, and cut nothing");
    find("moved-planes", prisms.moved.moved,
         "cuts along faces of the object were moved outwards by a millionth of its size");
    find("opposed-planes", prisms.moved.opposed,
         "cuts lie in faces that look to both sides; the larger area decided");
}

/// What assemblePieces promises, proven: over vertex ids, with a volume.
Result<void> proveClosed(const std::vector<LeafCut>& cuts, const std::string& where) {
    for (const LeafCut& leaf : cuts) {
        for (const PieceMesh& piece : leaf.pieces.pieces) {
            if (proveByIds(piece.triangles).closed()) continue;
            return fail(ErrorCode::notClosed,
                        "a piece of a volume cut is not closed; nothing was written. This is a "
                        "mistake in Sherd, please report it",
                        where);
        }
    }
    return {};
}

class CutSummary {
  public:
    explicit CutSummary(const PieceCuts& cuts) {
        for (const PieceCut& piece : cuts.pieces) {
            if (piece.refusal)
                refuse(*piece.refusal);
            else if (piece.isShared())
                addShared(piece, cuts.leaves);
            else
                add(cuts.leaves[piece.leaves[0]]);
        }
        empty = cells - std::min(cells, filled);
    }

    void tell(const VolumeCut& cut, BakedObjectReport& report) const {
        const auto find = [&](const char* code, uint32_t count, const std::string& message) {
            if (count > 0) report.findings.push_back({code, message, cut.text, count});
        };
        find("empty-cells", empty, "cells had nothing of their piece in them");
        find("slivers", slivers, "pieces of hardly any volume were joined to a neighbour");
        find("lumps", lumps,
             "pieces consist of parts that do not touch: the cell is whole, the "
             "object is not");
        find("moved-planes", moved,
             "cuts along faces of the object were moved outwards by a millionth of its size");
        find("opposed-planes", opposed,
             "cuts lie in faces that look to both sides; the larger area decided");
        find("folded-caps", fans, "cuts through a surface that crosses itself are folded");
        if (refused > 0) {
            find("uncut", refused,
                 "pieces could not be cut and stay whole, the first because " + first->message);
        }
    }

    uint32_t pieces = 0, divided = 0, refused = 0, cells = 0, filled = 0, empty = 0, slivers = 0,
             lumps = 0, moved = 0, opposed = 0, fans = 0;
    std::optional<Error> first;

  private:
    void refuse(const Error& error) {
        ++refused;
        ++pieces;
        if (!first) first = error;
    }

    /// A piece of one leaf.
    void add(const LeafCut& leaf) {
        if (leaf.refusal) return refuse(*leaf.refusal);
        if (leaf.cut.skinStart.empty()) {
            ++pieces;  // not chosen
            return;
        }
        const auto made = std::max(static_cast<uint32_t>(leaf.pieces.pieces.size()), 1U);
        pieces += made;
        divided += leaf.divided() ? 1 : 0;
        cells += leaf.cells;
        filled += made + leaf.pieces.slivers;
        moved += leaf.cut.report.movedPlanes;
        opposed += leaf.cut.report.opposedPlanes;
        addLeaf(leaf);
        for (const PieceMesh& piece : leaf.pieces.pieces) lumps += piece.lumps > 1 ? 1 : 0;
    }

    void addLeaf(const LeafCut& leaf) {
        slivers += leaf.pieces.slivers;
        fans += leaf.cut.report.fans;
    }

    void addShared(const PieceCut& piece, const std::vector<LeafCut>& leaves) {
        if (piece.cells == 0) {
            pieces += static_cast<uint32_t>(piece.leaves.size());  // not chosen
            return;
        }
        std::set<uint32_t> labels;
        for (const uint32_t leaf : piece.leaves) {
            const LeafCut& cut = leaves[leaf];
            labels.insert(cut.labels.begin(), cut.labels.end());
            pieces += static_cast<uint32_t>(cut.labels.size());
            if (cut.refusal) {
                ++refused;
                if (!first) first = cut.refusal;
            }
            addLeaf(cut);
        }
        divided += labels.size() > 1 ? 1 : 0;
        cells += piece.cells;
        filled += static_cast<uint32_t>(labels.size());
        moved += piece.movedPlanes;
        opposed += piece.opposedPlanes;
    }
};

/// The new pieces that several leaves make up.
std::set<uint32_t> piecesOfShared(const PieceCuts& cuts, const std::vector<uint32_t>& parents,
                                  const Components& components) {
    std::vector<uint8_t> shared(cuts.leaves.size(), 0);
    for (const PieceCut& piece : cuts.pieces)
        for (const uint32_t leaf : piece.leaves) shared[leaf] = piece.isShared() ? 1 : 0;
    std::set<uint32_t> pieces;
    for (uint32_t leaf = 0; leaf < parents.size(); ++leaf)
        if (shared[parents[leaf]] != 0) pieces.insert(components.at(components.levels, leaf));
    return pieces;
}

/// Of some pieces of the deepest level those of several parts that do not touch.
uint32_t countLumps(const std::set<uint32_t>& pieces, const PieceModel& model) {
    if (pieces.empty()) return 0;
    const std::vector<uint32_t> places = placesOf(model);
    const std::vector<std::vector<uint32_t>> faces = facesOfLeaves(model);
    const std::vector<std::vector<uint32_t>> leaves = leavesOfPieces(model.components);
    uint32_t count = 0;
    for (const uint32_t piece : pieces) {
        std::vector<uint32_t> all;
        for (const uint32_t leaf : leaves[piece])
            all.insert(all.end(), faces[leaf].begin(), faces[leaf].end());
        const LeafMesh mesh = leafMesh(model, places, all);
        UnionFind parts(mesh.positions.size());
        for (const auto& t : mesh.triangles) {
            parts.unite(t[0], t[1]);
            parts.unite(t[0], t[2]);
        }
        uint32_t lumps = 0;
        for (uint32_t v = 0; v < mesh.positions.size(); ++v) lumps += parts.find(v) == v ? 1 : 0;
        count += lumps > 1 ? 1 : 0;
    }
    return count;
}

}  // namespace

Result<std::vector<uint32_t>> cutLevel(const VolumeCut& cut, unsigned threads,
                                       const std::vector<PieceName>& names, const PieceModel& model,
                                       BakedObjectReport& report) {
    std::string where = "mesh \"" + model.mesh.name + "\", cut \"" + cut.text + "\"";
    if (!cut.where.empty()) where += ", " + cut.where;
    const Result<CutGrid> grid = CutGrid::around(model.mesh.positions, model.mesh.triangles);
    if (!grid) return tl::unexpected(grid.error());
    const VolumeCut inFrame = inObjectFrame(cut, model.mesh);
    std::optional<DrawnPrisms> prisms;
    if (cut.kind == VolumeCut::Kind::map) {
        Result<DrawnPrisms> drawn = drawnPrisms(inFrame, model, *grid);
        if (!drawn) return fail(drawn.error().code, drawn.error().message, where);
        prisms = std::move(*drawn);
        tellDrawing(cut, *prisms, report);
    }
    const Result<PieceCuts> done =
        cutPieces(inFrame, prisms ? &*prisms : nullptr, threads, names, *grid, model);
    if (!done) return fail(done.error().code, done.error().message, where);
    CutSummary summary(*done);
    if (summary.divided == 0 && summary.first)
        return fail(summary.first->code, summary.first->message, where);
    if (summary.divided == 0) {
        return fail(ErrorCode::separatesNothing,
                    cut.kind == VolumeCut::Kind::map
                        ? "the drawing divides no piece: draw lines that close around a part of "
                          "it, or that lead across it"
                        : "the cut divides no piece: each lies in one cell; ask for more cells",
                    where);
    }
    if (summary.pieces > kMostPieces) {
        return fail(ErrorCode::limitExceeded,
                    "the cut makes " + std::to_string(summary.pieces) +
                        " pieces; a bake holds at most " + std::to_string(kMostPieces),
                    where);
    }
    if (auto ok = proveClosed(done->leaves, where); !ok) return tl::unexpected(ok.error());
    JoinedPieces joined = joinPieces(done->leaves, model);
    summary.lumps += countLumps(piecesOfShared(*done, joined.parents, model.components), model);
    summary.tell(cut, report);
    if (joined.folded > 0) {
        report.findings.push_back({"walls-folded",
                                   "triangles of walls between pieces, too small to be cut alike "
                                   "on both sides, have a fold on one of them",
                                   cut.text, joined.folded});
    }
    if (joined.apart > 0) {
        report.findings.push_back({"walls-apart",
                                   "triangles of walls between pieces are cut in other ways on "
                                   "their two sides, being too small",
                                   cut.text, joined.apart});
    }
    report.levels.resize(model.components.levels + 1);
    report.levels.back().components = model.components.count.back();
    return std::move(joined.parents);
}

}  // namespace sherd
