// SPDX-License-Identifier: MIT
#include "bake_findings.h"

#include <algorithm>

#include "geometry/closed_mesh.h"
#include "message_text.h"

namespace sherd {
namespace {

std::string halfEdgePlace(const SurfaceMesh& mesh, uint32_t halfEdge) {
    const auto& t = mesh.triangles[halfEdge / 3];
    return "mesh \"" + mesh.name + "\", triangle " + std::to_string(halfEdge / 3) + ", edge from " +
           at(mesh.positions[t[halfEdge % 3]]) + " to " + at(mesh.positions[t[(halfEdge + 1) % 3]]);
}

}  // namespace

Result<void> judgeCaps(const SurfaceMesh& mesh, const std::vector<HoleCap>& caps, bool allowOpen,
                       BakedObjectReport& report) {
    BakeFinding closed{"capped", "", "", 0};
    BakeFinding left{"not-capped", "", "", 0};
    double area = 0;
    for (const HoleCap& cap : caps) {
        const std::string size = text("%.4g m around", cap.length);
        if (!cap.refusal.empty()) {
            ++left.count;
            left.places.push_back({cap.place, {}, size + ": " + cap.refusal});
            continue;
        }
        ++closed.count;
        area += cap.area;
        closed.places.push_back({cap.place, {}, size + text(", %.4g m2", cap.area)});
        report.caps.push_back({cap.place, cap.length, cap.area, cap.corners, cap.flat});
    }
    if (left.count > 0) {
        left.where = "mesh \"" + mesh.name + "\", around " + at(*left.places[0].position);
        left.message = "holes that cannot be capped, the first because " +
                       left.places[0].note.substr(left.places[0].note.find(": ") + 2);
        if (!allowOpen) {
            return fail(ErrorCode::openMesh,
                        counted(left.count, "hole") + " cannot be capped, the first because " +
                            left.message.substr(left.message.find("because ") + 8) +
                            "; close it in a modelling tool, or leave it open with --allow-open",
                        left.where);
        }
        report.findings.push_back(std::move(left));
    }
    if (closed.count > 0) {
        closed.message = "holes were closed by " + text("%.4g m2", area) +
                         " of hidden faces, which the intact object does not show";
        closed.where = "around " + at(*closed.places[0].position);
        report.findings.push_back(std::move(closed));
    }
    return {};
}

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
                            " with a triangle on one side only; close the mesh, let --cap-holes "
                            "close it, or bake it as it is with --allow-open (pieces then get a "
                            "rim along the border)",
                        place);
        }
        report.findings.push_back({"open-mesh",
                                   "the surface is open; the intact object stays so, its pieces "
                                   "are shells closed by a rim",
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

Result<void> judgeMerged(const Components& components, const CutSurface& cut,
                         const MendedPieces& pieces, const LevelOrder& order,
                         const BakedObjectReport& report) {
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
                        "all pieces that the lines of level " + std::to_string(order.ofDrawn(k)) +
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

namespace {

void judgeVolume(bool shells, BakedObjectReport& report) {
    const double share = report.levels[1].volumeShare;
    const bool hollow = !shells && share < 0.9;
    if (report.boundaryEdges > 0 || (!hollow && share <= 1.001)) return;
    report.findings.push_back(
        {"volume",
         "the pieces of level 1 hold " + text("%.4g %%", 100 * share) +
             " of the object's volume: its walls are too thin or its parts too close for the "
             "medial surface found; refine the mesh, or give it another \"interior\"",
         "", 1});
}

}  // namespace

void reportFragments(const FractureSet& set, bool shells, BakedObjectReport& report) {
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        BakedFragmentReport entry;
        entry.name = set.fragments[f].name;
        entry.level = set.fragments[f].level;
        entry.volume = set.fragments[f].volume;
        entry.closed = entry.volume > 0 &&
                       proveByPositions(set.geometry.positions, fragmentTriangles(set, f)).closed();
        report.fragments.push_back(std::move(entry));
    }
    report.bonds = static_cast<uint32_t>(set.bonds.size());
    for (uint32_t level = 0; level < report.levels.size(); ++level) {
        BakedLevelReport& entry = report.levels[level];
        double volume = 0;
        for (const uint32_t f : fragmentsAtLevel(set, level)) {
            ++entry.fragments;
            entry.closed += report.fragments[f].closed ? 1 : 0;
            volume += set.fragments[f].volume;
        }
        entry.volumeShare = report.volume > 0 ? volume / report.volume : 0;
    }
    judgeVolume(shells, report);
}

}  // namespace sherd
