// SPDX-License-Identifier: MIT
#include "bake_findings.h"

#include <algorithm>
#include <cstdio>

#include "geometry/closed_mesh.h"

namespace sherd {
namespace {

/// More than any engine simulates; far beyond it a slip of the pen would fill the memory.
constexpr uint32_t kMostPieces = 100000;

std::string text(const char* format, auto... values) {
    std::array<char, 160> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, values...);
    return buffer.data();
}

std::string counted(uint32_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string at(const glm::dvec3& p) {
    return text("(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
}

/// The places of the first few of many.
template <class Item, class Place>
std::string places(const std::vector<Item>& items, Place&& place) {
    constexpr size_t kShown = 3;
    std::string result;
    for (size_t i = 0; i < std::min(items.size(), kShown); ++i)
        result += (i == 0 ? "" : "; ") + place(items[i]);
    return items.size() > kShown ? result + "; ..." : result;
}

std::string placeOf(const Spot& spot) {
    const std::string uv = spot.uv ? text("UV (%.5g, %.5g) at ", spot.uv->x, spot.uv->y) : "";
    return uv + at(spot.position) + (spot.note.empty() ? "" : " [" + spot.note + "]");
}
std::string placeOf(const LooseEnd& end) {
    return text("UV (%.5g, %.5g)", end.uv.x, end.uv.y) + " at " + at(end.position);
}

/// What most likely keeps lines from separating, for the refusal.
std::string looseEnds(const CutSurface& cut) {
    std::string result;
    if (!cut.seams.loose.empty()) {
        result.append(". Line ends without a continuation over a chart border: ")
            .append(places(cut.seams.loose, [](const LooseEnd& e) { return placeOf(e); }));
    }
    if (!cut.deadEnds.empty()) {
        result.append(". Lines ending in the surface: ")
            .append(places(cut.deadEnds, [](const Spot& e) { return placeOf(e); }));
    }
    return result;
}

std::string halfEdgePlace(const SurfaceMesh& mesh, uint32_t halfEdge) {
    const auto& t = mesh.triangles[halfEdge / 3];
    return "mesh \"" + mesh.name + "\", triangle " + std::to_string(halfEdge / 3) + ", edge from " +
           at(mesh.positions[t[halfEdge % 3]]) + " to " + at(mesh.positions[t[(halfEdge + 1) % 3]]);
}

}  // namespace

Result<void> judgeTopology(const SurfaceMesh& mesh, const MeshTopology& topology, bool allowOpen,
                           BakedObjectReport& report) {
    report.boundaryEdges = topology.boundaryEdges;
    const auto degenerate = static_cast<uint32_t>(
        std::count(topology.degenerate.begin(), topology.degenerate.end(), 1));
    if (degenerate == mesh.triangles.size()) {
        return fail(ErrorCode::noTriangles, "the mesh has no triangle with three different corners",
                    "mesh \"" + mesh.name + "\"");
    }
    if (degenerate > 0) {
        report.findings.push_back({"degenerate-triangles",
                                   "triangles with two equal corners were left out", "",
                                   degenerate});
    }
    if (topology.pinchedEdges > 0) {
        report.findings.push_back(
            {"pinched-edges",
             "the surface touches itself along edges; they were told apart by the solid between",
             "", topology.pinchedEdges});
    }
    if (topology.nonManifoldEdges > 0) {
        const std::string place = halfEdgePlace(mesh, topology.firstNonManifoldHalfEdge);
        if (!allowOpen) {
            return fail(ErrorCode::nonManifoldMesh,
                        counted(topology.nonManifoldEdges, "edge") +
                            " used by too many triangles or by triangles wound against each other, "
                            "so the surface encloses no solid; mend the mesh, or bake it as it is "
                            "with --allow-open",
                        place);
        }
        report.findings.push_back(
            {"non-manifold", "edges used unequally in their two directions were treated as open",
             place, topology.nonManifoldEdges});
    }
    if (topology.boundaryEdges > 0) {
        const std::string place = halfEdgePlace(mesh, topology.firstBoundaryHalfEdge);
        if (!allowOpen) {
            return fail(ErrorCode::openMesh,
                        "the surface is open: " + counted(topology.boundaryEdges, "edge") +
                            " with a triangle on one side only; close the mesh, or bake it as it "
                            "is with --allow-open (pieces then get a rim along the border)",
                        place);
        }
        report.findings.push_back(
            {"open-mesh",
             "the surface is open; the intact object stays so, its pieces are closed by a rim",
             place, topology.boundaryEdges});
    }
    const glm::dvec3 origin = mesh.positions[mesh.triangles[0][0]];
    report.volume = signedVolume(mesh.positions, mesh.triangles, origin);
    if (topology.boundaryEdges + topology.nonManifoldEdges == 0 && !(report.volume > 0)) {
        return fail(ErrorCode::invalidData,
                    "the surface encloses no positive volume (" + text("%.6g", report.volume) +
                        "): it is flat or inside out; flip its faces in a modelling tool",
                    "mesh \"" + mesh.name + "\"");
    }
    return {};
}

Result<void> judgeSeparation(const Components& components, const CutSurface& cut,
                             BakedObjectReport& report) {
    report.levels.resize(components.levels + 1);
    report.levels[0].components = report.parts = components.parts;
    uint32_t before = cut.hasCells(1) ? 1 : components.parts;
    for (uint32_t k = 1; k <= components.levels; ++k) {
        const uint32_t count = components.count[k - 1];
        report.levels[k].components = count;
        if (count > kMostPieces) {
            return fail(ErrorCode::limitExceeded,
                        "the lines of level " + std::to_string(k) + " make " +
                            std::to_string(count) + " components; a bake holds at most " +
                            std::to_string(kMostPieces),
                        "mesh \"" + report.name + "\"");
        }
        if (count <= before) {
            if (cut.hasCells(k)) {
                return fail(ErrorCode::separatesNothing,
                            "the pattern of level " + std::to_string(k) +
                                " asks for no more than " + counted(count, "piece") +
                                ", which there " + (count == 1 ? "is" : "are") +
                                " without it; ask for more",
                            "mesh \"" + report.name + "\"");
            }
            return fail(ErrorCode::separatesNothing,
                        "the lines of level " + std::to_string(k) +
                            " separate nothing: the surface has " + counted(count, "component") +
                            " with and without them; draw lines that close around a piece, and "
                            "that meet on both sides of every chart border they cross; of a file "
                            "with several objects bake those the map is for, with --node" +
                            looseEnds(cut),
                        "mesh \"" + report.name + "\"");
        }
        before = count;
    }
    return {};
}

Result<void> judgeMerged(const Components& components, const CutSurface& cut,
                         const MendedPieces& pieces, const BakedObjectReport& report) {
    const std::string where = "mesh \"" + report.name + "\"";
    if (pieces.empty > 0) {
        return fail(
            ErrorCode::invalidData,
            counted(pieces.empty, "piece") +
                " without volume: the surface is flat or has no inside; give it a thickness",
            where);
    }
    uint32_t before = cut.hasCells(1) ? 1 : report.parts;
    for (uint32_t k = 1; k <= components.levels; ++k) {
        if (components.count[k - 1] <= before) {
            return fail(ErrorCode::separatesNothing,
                        "all pieces that the lines of level " + std::to_string(k) +
                            " separate are too small and were joined to their neighbours; draw "
                            "larger ones or "
                            "lower minimumComponentShare in a recipe",
                        where);
        }
        before = components.count[k - 1];
    }
    return {};
}

Result<void> judgeSize(const SurfaceMesh& mesh, double diagonal) {
    constexpr double kSmallest = 1e-6;
    constexpr double kLargest = 1e7;
    if (diagonal >= kSmallest && diagonal <= kLargest) return {};
    return fail(ErrorCode::limitExceeded,
                "the object is " + text("%.4g", diagonal) +
                    " m across; Sherd bakes objects from 1e-6 to 1e7 m: scale it to its true size",
                "mesh \"" + mesh.name + "\"");
}

void reportCells(const std::vector<CellReport>& cells, BakedObjectReport& report) {
    for (const CellReport& cell : cells) {
        std::string message = "the pattern " + cell.text + " made " + counted(cell.made, "piece");
        if (cell.made != cell.asked) message += ", " + std::to_string(cell.asked) + " were asked";
        if (cell.domains > cell.asked)
            message += "; what it divides is in " + counted(cell.domains, "part") +
                       " that do not touch, and each is a piece at least";
        else if (cell.made > cell.asked && cell.domains > 1)
            message += "; its cells are cut by the borders of " + counted(cell.domains, "piece") +
                       " of the level before";
        else if (cell.made > cell.asked)
            message += "; its cells end at the borders of charts or sides";
        else if (cell.made < cell.asked)
            message += "; some of its cells do not meet the surface";
        if (cell.strays > 0)
            message += "; " + counted(cell.strays, "stray bit") +
                       " of cells joined the neighbour with the longest border";
        report.findings.push_back({"pattern", message, "level " + std::to_string(cell.level), 1});
    }
}

void reportCutting(const CutSurface& cut, BakedObjectReport& report) {
    for (const std::string& warning : cut.warnings)
        report.findings.push_back({"map", warning, "", 1});
    if (cut.seams.averaged > 0) {
        report.findings.push_back({"averaged", "pairs of line ends at seams were moved together",
                                   "", cut.seams.averaged});
    }
    if (!cut.seams.loose.empty()) {
        report.findings.push_back(
            {"loose-ends", "lines end at a chart border and go on nowhere on its other side",
             places(cut.seams.loose, [](const LooseEnd& e) { return placeOf(e); }),
             static_cast<uint32_t>(cut.seams.loose.size())});
    }
    if (!cut.deadEnds.empty()) {
        report.findings.push_back({"dead-ends", "lines end in the surface",
                                   places(cut.deadEnds, [](const Spot& e) { return placeOf(e); }),
                                   static_cast<uint32_t>(cut.deadEnds.size())});
    }
}

void reportPieces(const std::vector<MergedLeaf>& small, const MendedPieces& pieces,
                  BakedObjectReport& report) {
    const auto place = [](const MergedLeaf& leaf) {
        return "near " + at(leaf.position) + text(", area %.3g", leaf.area);
    };
    if (!small.empty()) {
        report.findings.push_back({"merged-small",
                                   "components too small to be a piece joined a neighbour",
                                   places(small, place), static_cast<uint32_t>(small.size())});
    }
    if (!pieces.merged.empty()) {
        report.findings.push_back({"merged-empty", "pieces without volume joined a neighbour",
                                   places(pieces.merged, place),
                                   static_cast<uint32_t>(pieces.merged.size())});
    }
    if (pieces.shelled > 0) {
        report.findings.push_back({"shelled",
                                   "pieces to which the medial surface gives no thickness got a "
                                   "shell; the mesh is coarse "
                                   "there, refine it for fuller pieces",
                                   "", pieces.shelled});
    }
    if (pieces.thinned > 0) {
        report.findings.push_back(
            {"thinned", "pieces turned inside out by the medial surface were made thinner", "",
             pieces.thinned});
    }
}

void reportFragments(const FractureSet& set, BakedObjectReport& report) {
    std::vector<uint8_t> closed(set.fragments.size());
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        closed[f] =
            proveByPositions(set.geometry.positions, fragmentTriangles(set, f)).closed() ? 1 : 0;
    }
    report.bonds = static_cast<uint32_t>(set.bonds.size());
    for (uint32_t level = 0; level < report.levels.size(); ++level) {
        BakedLevelReport& entry = report.levels[level];
        double volume = 0;
        for (const uint32_t f : fragmentsAtLevel(set, level)) {
            ++entry.fragments;
            entry.closed += closed[f];
            volume += set.fragments[f].volume;
        }
        entry.volumeShare = report.volume > 0 ? volume / report.volume : 0;
    }
    const double share = report.levels[1].volumeShare;
    if (report.boundaryEdges == 0 && (share < 0.9 || share > 1.001)) {
        report.findings.push_back(
            {"volume",
             "the pieces of level 1 hold " + text("%.4g %%", 100 * share) +
                 " of the object's volume: its walls are too thin or its parts too close for the "
                 "medial "
                 "surface found; set \"interior\": {\"preSmoothing\": 1} in a recipe, or refine "
                 "the mesh",
             "", 1});
    }
}

}  // namespace sherd
