// SPDX-License-Identifier: MIT
// What became of a drawing: the edges that its lines left in the cut surface, taken back to the
// page. A vertex of the cut surface is a weighted sum of corners of the triangle it lies in, so its
// place on the page is the same sum of where these corners are drawn.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "bake_findings.h"
#include "layout/drawn_places.h"
#include "layout/drawn_triangle.h"
#include "layout/uv_wireframe.h"
#include "sherd/baker/layout.h"
#include "surface/component_merging.h"
#include "surface/cut_settings.h"
#include "surface/vertex_fans.h"

namespace sherd {

namespace {

using Segment = std::array<glm::dvec2, 2>;

struct PointLess {
    bool operator()(const glm::dvec2& a, const glm::dvec2& b) const {
        return std::tie(a.x, a.y) < std::tie(b.x, b.y);
    }
};

/// Where a vertex of the cut surface is drawn in one of the mesh's triangles.
glm::dvec2 drawnVertex(const SurfaceMesh& mesh, uint32_t triangle, const DrawnTriangle& drawn,
                       const VertexOrigin& origin) {
    glm::dvec2 at(0.0);
    // In the origin's order, so that both sides of an edge within a chart give the same bits.
    for (size_t j = 0; j < 3; ++j) {
        const double weight = origin.weights[static_cast<int>(j)];
        if (weight == 0) continue;
        const auto& corners = mesh.triangles[triangle];
        const auto k = std::find(corners.begin(), corners.end(), origin.vertices[j]);
        if (k == corners.end()) return glm::dvec2(NAN);
        at += glm::dvec2(drawn.points[static_cast<size_t>(k - corners.begin())]) * weight;
    }
    return at;
}

bool isFinite(const glm::dvec2& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Segments as few polylines, each segment once however many triangles gave it.
OverlayLine::Chains chainSegments(const std::vector<Segment>& segments) {
    std::vector<glm::dvec2> points;
    for (const Segment& s : segments) points.insert(points.end(), s.begin(), s.end());
    std::sort(points.begin(), points.end(), PointLess());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto idOf = [&](const glm::dvec2& p) {
        return static_cast<uint32_t>(
            std::lower_bound(points.begin(), points.end(), p, PointLess()) - points.begin());
    };
    std::vector<std::array<uint32_t, 2>> edges;
    for (const Segment& s : segments) {
        const std::array<uint32_t, 2> ends = {idOf(s[0]), idOf(s[1])};
        if (ends[0] != ends[1])
            edges.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    OverlayLine::Chains chains;
    for (const std::vector<uint32_t>& chain : chainEdges(points.size(), edges)) {
        std::vector<glm::dvec2>& out = chains.emplace_back();
        for (const uint32_t p : chain) out.push_back(points[p]);
    }
    return chains;
}

std::vector<OverlayLine> drawnLines(const SurfaceMesh& mesh, const CutSurface& cut,
                                    const Components& components) {
    const DrawnMesh drawnMesh(mesh);
    std::map<uint32_t, std::array<std::vector<Segment>, 2>> ofMark;  // idle, parting
    for (uint32_t h = 0; h < 3 * cut.surface.triangles.size(); ++h) {
        const SplitTriangle& triangle = cut.surface.triangles[h / 3];
        const uint32_t mark = triangle.line[h % 3];
        if (mark == 0 || triangle.source >= drawnMesh.size()) continue;
        const uint32_t o = cut.topology.opposite[h];
        const bool parts = o != kNone && components.leaf[h / 3] != components.leaf[o / 3];
        const DrawnTriangle drawn = drawnMesh[triangle.source];
        Segment segment;
        for (uint32_t end = 0; end < 2; ++end) {
            const uint32_t v = triangle.v[(h % 3 + end) % 3];
            segment[end] = drawnVertex(mesh, triangle.source, drawn, cut.surface.origins[v]);
        }
        if (isFinite(segment[0]) && isFinite(segment[1]))
            ofMark[mark][parts ? 1 : 0].push_back(segment);
    }
    std::vector<OverlayLine> lines;
    for (const auto& [mark, segments] : ofMark) {
        const LineTable::Line& line = cut.lines.line(mark);
        lines.push_back(
            {line.level, line.source, chainSegments(segments[1]), chainSegments(segments[0])});
    }
    return lines;
}

/// Places of projected drawings that touch nothing lie on a page that is not this one.
bool isOnPage(const FracturePlan& plan, const BakeFinding& finding) {
    if (finding.code != "off-charts" && finding.code != "closed-gaps") return true;
    return std::all_of(plan.drawings.begin(), plan.drawings.end(), [](const auto& drawing) {
        return drawing.projection.kind == Projection::Kind::uv;
    });
}

void movePlaces(const FracturePlan& plan, const DrawnPlaces& page,
                std::vector<BakeFinding>& findings) {
    for (BakeFinding& finding : findings) {
        const bool onPage = isOnPage(plan, finding);
        for (BakePlace& place : finding.places) {
            if (!onPage) place.uv.reset();
            if (place.uv) place.uv = page.drawn(place);
        }
    }
}

}  // namespace

Result<LayoutOverlay> inspectLines(const SurfaceMesh& mesh, const FracturePlan& plan,
                                   const Recipe& recipe) {
    LayoutOverlay overlay;
    if (DrawnMesh(mesh).size() == 0) return overlay;
    SurfaceMesh apart = mesh;
    MeshTopology topology = buildTopology(apart.positions, apart.triangles);
    if (separateFans(topology, apart) > 0)
        topology = buildTopology(apart.positions, apart.triangles);
    const double diagonal = diagonalOf(apart);
    const Result<CutSurface> cut =
        cutSurface(apart, topology, plan, cutOptionsOf(recipe, diagonal));
    if (!cut) return tl::unexpected(cut.error());
    if (cut->lines.size() == 0) return overlay;

    BakedObjectReport report;
    report.name = mesh.name;
    std::vector<CellReport> cells;
    Components components = componentsOf(*cut, cells);
    const LevelOrder order(plan, cut->lines);
    reportCells(cells, order, report);
    reportCutting(apart, *cut, components, report);
    if (const auto ok = judgeSeparation(components, *cut, order, report); !ok) {
        const bool few = ok.error().code == ErrorCode::separatesNothing;
        report.findings.push_back({few ? "separates-nothing" : "too-many-components",
                                   ok.error().message, ok.error().where, 1});
    }
    const std::vector<MergedLeaf> small =
        mergeSmallLeaves(cut->surface, cut->topology, recipe.minimumComponentShare, components);
    reportPieces(apart, small, {}, report);

    overlay.lines = drawnLines(apart, *cut, components);
    overlay.findings = std::move(report.findings);
    movePlaces(plan, DrawnPlaces(apart, 1e-3 * diagonal), overlay.findings);
    return overlay;
}

}  // namespace sherd
