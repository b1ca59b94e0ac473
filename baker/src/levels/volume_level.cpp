// SPDX-License-Identifier: MIT
#include "levels/volume_level.h"

#include <algorithm>
#include <utility>

#include "geometry/closed_mesh.h"
#include "geometry/parallel_for.h"
#include "levels/leaf_cut.h"
#include "levels/piece_joining.h"
#include "message_text.h"
#include "sherd/baker/pattern.h"

namespace sherd {
namespace {

/// A scene's places in the object's frame, as its pieces are.
VolumeCut inObjectFrame(VolumeCut cut, const SurfaceMesh& mesh) {
    for (std::vector<glm::dvec3>* places : {&cut.around, &cut.points, &cut.only.near})
        for (glm::dvec3& p : *places) p = toObjectFrame(mesh.restPose, p);
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

Result<std::vector<LeafCut>> cutLeaves(const VolumeCut& cut, unsigned threads,
                                       const std::vector<PieceName>& names, const CutGrid& grid,
                                       const PieceModel& model, BakedObjectReport& report) {
    const std::vector<std::vector<uint32_t>> faces = facesOfLeaves(model);
    const Result<std::vector<uint8_t>> chosen = chooseLeaves(cut.only, model, names, faces);
    if (!chosen) return tl::unexpected(chosen.error());
    const std::vector<uint32_t> places = placesOf(model);
    std::optional<DrawnPrisms> prisms;
    if (cut.kind == VolumeCut::Kind::map) {
        Result<DrawnPrisms> drawn = drawnPrisms(cut, model, grid);
        if (!drawn) return tl::unexpected(drawn.error());
        prisms = std::move(*drawn);
        tellDrawing(cut, *prisms, report);
    }
    std::vector<LeafCut> cuts(faces.size());
    parallelRuns(faces.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t leaf = first; leaf < last; ++leaf) {
            if ((*chosen)[leaf] == 0) continue;
            if (prisms) {
                cuts[leaf] = cutLeaf(leafMesh(model, places, faces[leaf]), *prisms, grid);
                continue;
            }
            // Seeds of neighbours are far apart.
            const uint64_t seed = cut.seed + leaf * 0x9E3779B97F4A7C15ULL;
            cuts[leaf] = cutLeaf(leafMesh(model, places, faces[leaf]), cut, seed, grid);
        }
    });
    return cuts;
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
    explicit CutSummary(const std::vector<LeafCut>& cuts) {
        for (const LeafCut& leaf : cuts) {
            if (leaf.refusal) {
                ++refused;
                if (!first) first = leaf.refusal;
                continue;
            }
            if (leaf.cut.skinStart.empty()) {
                ++others;
                continue;
            }
            const MeshCut::Report& report = leaf.cut.report;
            const auto made = static_cast<uint32_t>(leaf.pieces.pieces.size());
            pieces += std::max(made, 1U);
            divided += leaf.divided() ? 1 : 0;
            cells += leaf.cells;
            slivers += leaf.pieces.slivers;
            moved += report.movedPlanes;
            opposed += report.opposedPlanes;
            fans += report.fans;
            for (const PieceMesh& piece : leaf.pieces.pieces) lumps += piece.lumps > 1 ? 1 : 0;
        }
        empty = cells - std::min(cells, pieces + slivers);
        pieces += refused + others;
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

    uint32_t pieces = 0, divided = 0, refused = 0, others = 0, cells = 0, empty = 0, slivers = 0,
             lumps = 0, moved = 0, opposed = 0, fans = 0;
    std::optional<Error> first;
};

}  // namespace

Result<void> cutLevel(const VolumeCut& cut, unsigned threads, const std::vector<PieceName>& names,
                      const PieceModel& model, BakedObjectReport& report) {
    std::string where = "mesh \"" + model.mesh.name + "\", cut \"" + cut.text + "\"";
    if (!cut.where.empty()) where += ", " + cut.where;
    const Result<CutGrid> grid = CutGrid::around(model.mesh.positions, model.mesh.triangles);
    if (!grid) return tl::unexpected(grid.error());
    const Result<std::vector<LeafCut>> done =
        cutLeaves(inObjectFrame(cut, model.mesh), threads, names, *grid, model, report);
    if (!done) return fail(done.error().code, done.error().message, where);
    const std::vector<LeafCut>& cuts = *done;
    const CutSummary summary(cuts);
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
    if (auto ok = proveClosed(cuts, where); !ok) return ok;
    const uint32_t apart = joinPieces(cuts, model);
    summary.tell(cut, report);
    if (apart > 0) {
        report.findings.push_back({"walls-apart",
                                   "triangles of walls between pieces are cut in other ways on "
                                   "their two sides, being too small",
                                   cut.text, apart});
    }
    report.levels.resize(model.components.levels + 1);
    report.levels.back().components = model.components.leafCount;
    return {};
}

}  // namespace sherd
