// SPDX-License-Identifier: MIT
// What there is to say of lines and the components they make: help for the artist who drew them.
#include <algorithm>
#include <cmath>

#include "appearance/outer_shading.h"
#include "bake_findings.h"
#include "message_text.h"
#include "surface/uv_triangle.h"

namespace sherd {
namespace {

constexpr size_t kMostPlaces = 1000;

std::string placeOf(const BakePlace& place) {
    std::string result = place.uv ? text("UV (%.5g, %.5g)", place.uv->x, place.uv->y) : "";
    if (place.position) result += (result.empty() ? "" : " at ") + at(*place.position);
    return place.note.empty() ? result : result + " [" + place.note + "]";
}

/// The places of the first few of many.
std::string firstFew(const std::vector<BakePlace>& places) {
    constexpr size_t kShown = 3;
    std::string result;
    for (size_t i = 0; i < std::min(places.size(), kShown); ++i)
        result += (i == 0 ? "" : "; ") + placeOf(places[i]);
    return places.size() > kShown ? result + "; ..." : result;
}

void add(BakedObjectReport& report, const char* code, const std::string& message,
         std::vector<BakePlace> places) {
    if (places.empty()) return;
    BakeFinding finding{code, message, firstFew(places), static_cast<uint32_t>(places.size())};
    if (places.size() > kMostPlaces) places.resize(kMostPlaces);
    finding.places = std::move(places);
    report.findings.push_back(std::move(finding));
}

std::vector<BakePlace> placesOf(const std::vector<LooseEnd>& ends) {
    std::vector<BakePlace> places;
    places.reserve(ends.size());
    for (const LooseEnd& end : ends) places.push_back({end.position, end.uv, ""});
    return places;
}

std::vector<BakePlace> placesOf(const SurfaceMesh& mesh, const std::vector<MergedLeaf>& leaves) {
    std::vector<BakePlace> places;
    places.reserve(leaves.size());
    for (const MergedLeaf& leaf : leaves)
        places.push_back(
            {leaf.position, uvOf(mesh, leaf.source, leaf.position), text("area %.3g", leaf.area)});
    return places;
}

/// What most likely keeps lines from separating, for the refusal.
std::string hints(const CutSurface& cut) {
    std::string result;
    const auto hint = [&result](const char* what, const std::vector<BakePlace>& places) {
        if (!places.empty()) result.append(what).append(firstFew(places));
    };
    hint(". Line ends without a continuation over a chart border: ", placesOf(cut.seams.loose));
    hint(". Lines ending in the surface: ", cut.deadEnds);
    hint(". Lines outside every chart: ", cut.offCharts);
    hint(". Places off the surface: ", cut.offSurface);
    hint(". No way over the surface to: ", cut.gaps);
    return result;
}

/// Lines of which no piece has two components on its sides: one place each.
std::vector<BakePlace> idleLines(const SurfaceMesh& mesh, const CutSurface& cut,
                                 const Components& components) {
    std::vector<uint32_t> somewhere(cut.lines.size() + 1, kNone);
    std::vector<uint8_t> separates(cut.lines.size() + 1, 0);
    for (uint32_t h = 0; h < 3 * cut.surface.triangles.size(); ++h) {
        const uint32_t mark = cut.surface.triangles[h / 3].line[h % 3];
        if (mark == 0) continue;
        somewhere[mark] = h;
        const uint32_t o = cut.topology.opposite[h];
        if (o != kNone && components.leaf[h / 3] != components.leaf[o / 3]) separates[mark] = 1;
    }
    std::vector<BakePlace> places;
    for (uint32_t mark = 1; mark < somewhere.size(); ++mark) {
        if (somewhere[mark] == kNone || separates[mark] != 0) continue;
        const SplitTriangle& triangle = cut.surface.triangles[somewhere[mark] / 3];
        const glm::dvec3 position = cut.surface.positions[triangle.v[somewhere[mark] % 3]];
        places.push_back(
            {position, uvOf(mesh, triangle.source, position), cut.lines.line(mark).source});
    }
    return places;
}

}  // namespace

Result<void> judgeSeparation(const Components& components, const CutSurface& cut,
                             const LevelOrder& order, BakedObjectReport& report) {
    report.levels.resize(components.levels + 1);
    report.levels[0].components = report.parts = components.parts;
    uint32_t before = cut.hasCells(1) ? 1 : components.parts;
    for (uint32_t k = 1; k <= components.levels; ++k) {
        const uint32_t count = components.count[k - 1];
        const std::string level = std::to_string(order.ofDrawn(k));
        report.levels[k].components = count;
        if (count > kMostPieces) {
            return fail(ErrorCode::limitExceeded,
                        "the lines of level " + level + " make " + std::to_string(count) +
                            " components; a bake holds at most " + std::to_string(kMostPieces),
                        "mesh \"" + report.name + "\"");
        }
        if (count <= before) {
            if (cut.hasCells(k)) {
                return fail(ErrorCode::separatesNothing,
                            "the pattern of level " + level + " asks for no more than " +
                                counted(count, "piece") + ", which there " +
                                (count == 1 ? "is" : "are") + " without it; ask for more",
                            "mesh \"" + report.name + "\"");
            }
            return fail(ErrorCode::separatesNothing,
                        "the lines of level " + level + " separate nothing: the surface has " +
                            counted(count, "component") +
                            " with and without them; draw lines that close around a piece, and "
                            "that meet on both sides of every chart border they cross; of a file "
                            "with several objects bake those the map is for, with --node" +
                            hints(cut),
                        "mesh \"" + report.name + "\"");
        }
        before = count;
    }
    return {};
}

void reportCells(const std::vector<CellReport>& cells, const LevelOrder& order,
                 BakedObjectReport& report) {
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
        report.findings.push_back(
            {"pattern", message, "level " + std::to_string(order.ofDrawn(cell.level)), 1});
    }
}

void reportCutting(const SurfaceMesh& mesh, const CutSurface& cut, const Components& components,
                   BakedObjectReport& report) {
    for (const std::string& warning : cut.warnings)
        report.findings.push_back({"map", warning, "", 1});
    if (cut.seams.averaged > 0) {
        report.findings.push_back({"averaged", "pairs of line ends at seams were moved together",
                                   "", cut.seams.averaged});
    }
    add(report, "closed-gaps", "dangling line ends were led on to a line", cut.closedGaps);
    add(report, "loose-ends", "lines end at a chart border and go on nowhere on its other side",
        placesOf(cut.seams.loose));
    add(report, "dead-ends", "lines end in the surface", cut.deadEnds);
    add(report, "off-charts", "lines lie outside every chart", cut.offCharts);
    add(report, "off-surface",
        "places are too far from the surface (--snap-distance) or outside every chart; the line "
        "stops there",
        cut.offSurface);
    add(report, "gaps", "no way leads over the surface to the next place of a line", cut.gaps);
    add(report, "along-edges",
        "no plane leads over the surface to a place; the line follows edges of the mesh",
        cut.alongEdges);
    add(report, "idle-lines", "lines separate nothing", idleLines(mesh, cut, components));
}

void reportShading(const SurfaceMesh& mesh, const CutSurface& cut, BakedObjectReport& report) {
    // Of 255 steps of light three: what a normal that turns so far can make of full light.
    constexpr double kSeen = 3.0 / 255 * 180 / M_PI;
    const ShadingShift shift = shadingShift(mesh, cut.surface, kSeen);
    if (shift.triangles == 0) return;
    BakeFinding finding{"shading", "", "", shift.triangles};
    finding.message =
        "triangles over which normals turn far are shaded otherwise once they are cut: normals "
        "by " +
        text("%.2g degrees", shift.degrees) + " at most, which is up to " +
        text("%.0f", std::ceil(255 * std::sin(shift.degrees * M_PI / 180))) +
        "/255 of full light; use smaller triangles or a sharp edge there";
    finding.where = "near " + at(shift.place);
    finding.places.push_back({shift.place, {}, ""});
    report.findings.push_back(std::move(finding));
}

void reportPieces(const SurfaceMesh& mesh, const std::vector<MergedLeaf>& small,
                  const MendedPieces& pieces, BakedObjectReport& report) {
    add(report, "merged-small", "components too small to be a piece joined a neighbour",
        placesOf(mesh, small));
    add(report, "merged-empty", "pieces without volume joined a neighbour",
        placesOf(mesh, pieces.merged));
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

void reportCarried(const CarriedLines& carried, BakedObjectReport& report) {
    if (carried.edges > 0) {
        report.findings.push_back({"carried",
                                   "pieces of line were carried through to the far side, which had "
                                   "none there",
                                   "", carried.edges});
    }
    add(report, "over-rim", "line ends were led over a rim to the far side", carried.rims);
}

void reportSolid(const SurfaceMesh& mesh, const CutSurface& cut, const Components& components,
                 const SolidLeaves& solid, BakedObjectReport& report) {
    if (solid.strays > 0) {
        report.findings.push_back({"stray-lumps",
                                   "stray bits of a pattern's cells joined the neighbour with the "
                                   "largest common wall",
                                   "", solid.strays});
    }
    const std::vector<MergedLeaf> all = placesOfLeaves(cut.surface, components);
    std::vector<MergedLeaf> left;
    double area = 0;
    double whole = 0;
    for (uint32_t leaf = 0; leaf < all.size(); ++leaf) {
        whole += all[leaf].area;
        if (solid.contains(leaf)) continue;
        area += all[leaf].area;
        left.push_back(all[leaf]);
    }
    add(report, "solid-fallback",
        "pieces could not be cut straight through and have a medial sheet inside; they hold " +
            text("%.3g %%", 100 * area / whole) + " of the surface",
        placesOf(mesh, left));
}

}  // namespace sherd
