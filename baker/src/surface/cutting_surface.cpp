// SPDX-License-Identifier: MIT
#include "surface/cutting_surface.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "geometry/triangle.h"
#include "message_text.h"
#include "surface/triangulation.h"

namespace sherd {
namespace {

/// A line that ends this near another, in page units, was most likely meant to reach it.
constexpr double kSmallGap = 0.02;
constexpr size_t kMostNotes = 1000;

std::string gapNote(double distance) {
    return text(", %.2g short of a line: --close-gaps %.2g leads it there", distance,
                1.2 * distance);
}

}  // namespace

CuttingSurface::CuttingSurface(const SurfaceMesh& sourceMesh, const MeshTopology& topology,
                               const CutOptions& cutOptions)
    : mesh(sourceMesh), options(cutOptions) {
    result.surface = uncutSurface(mesh);
    result.topology = topology;
    result.splitPatches = options.splitPatches;
}

Result<void> CuttingSurface::cutAlong(const Pass& pass, std::span<const Cut> cuts) {
    ResolvedEdges edges = resolveEdges(result.topology, result.surface, cuts);
    SeamReport seams;
    if (pass.seamLine != 0) markSeams(pass, edges);
    if (pass.seams)
        seams = joinAcrossSeams(result.topology, result.surface, pass.frames, cuts, result.lines,
                                options.seams, edges);
    std::vector<uint32_t> from;
    const SplitInput input{result.surface, result.topology, pass.frames, pass.map, cuts, edges};
    Result<SplitSurface> split = splitSurface(input, result.cells.empty() ? nullptr : &from);
    if (!split) return tl::unexpected(split.error());
    findDeadEnds(pass, cuts);
    result.surface = std::move(*split);
    result.topology = buildTopology(result.surface.positions, vertexTriangles(result.surface));
    for (CellLevel& cells : result.cells) {
        std::vector<uint32_t> domain;
        domain.reserve(from.size());
        for (const uint32_t t : from) domain.push_back(cells.domain[t]);
        cells.domain = std::move(domain);
    }
    result.seams.joined += seams.joined;
    result.seams.loose.insert(result.seams.loose.end(), seams.loose.begin(), seams.loose.end());
    return {};
}

void CuttingSurface::markSeams(const Pass& pass, ResolvedEdges& edges) const {
    for (uint32_t h = 0; h < result.topology.opposite.size(); ++h) {
        if (!isUvSeam(result.topology, pass.frames, h)) continue;
        const uint32_t edge = result.topology.halfEdgeEdge[h];
        for (uint32_t p = 0; p <= edges.pointCount(edge); ++p)
            edges.markPiece(edges.firstPiece(edge) + p, pass.seamLine);
    }
}

void CuttingSurface::findDeadEnds(const Pass& pass, std::span<const Cut> cuts) {
    std::vector<uint32_t> degree(pass.map.nodes.size(), 0);
    for (const MapEdge& edge : pass.map.edges) {
        ++degree[edge.from];
        ++degree[edge.to];
    }
    std::vector<std::pair<uint32_t, const Cut*>> cutOfNode;
    std::optional<MapIndex> index;
    for (const Cut& cut : cuts) {
        for (const bool atStart : {true, false}) {
            const CutEnd& end = atStart ? cut.from : cut.to;
            if (end.where == CutEnd::Where::inside && degree[end.node] == 1)
                cutOfNode.emplace_back(end.node, &cut);
            if (end.where != CutEnd::Where::edge || !pass.seams) continue;
            const MapEdge& edge = pass.map.edges[cut.mapEdge];
            const uint32_t node = atStart ? edge.from : edge.to;
            if (degree[node] == 1 && endsOnEdge(pass, cut.triangle, end, node))
                cutOfNode.emplace_back(node, &cut);
        }
    }
    const auto byNode = [](const auto& x, const auto& y) { return x.first < y.first; };
    std::stable_sort(cutOfNode.begin(), cutOfNode.end(), byNode);
    const auto sameNode = [](const auto& x, const auto& y) { return x.first == y.first; };
    cutOfNode.erase(std::unique(cutOfNode.begin(), cutOfNode.end(), sameNode), cutOfNode.end());
    for (const auto& [node, cut] : cutOfNode) {
        const glm::dvec3 position =
            positionAt(cut->triangle, pass.frames[cut->triangle], nodeUv(pass.map, node));
        // Nobody reads more notes than this; ten thousand lines have twice as many ends.
        const bool noted = result.deadEnds.size() < kMostNotes;
        std::string note = noted ? result.lines.line(cut->line).source : "";
        if (pass.seams && noted) {
            if (!index) index.emplace(pass.map);
            const auto ahead = lineNear(pass.map, *index, node, cut->mapEdge, kSmallGap);
            if (ahead) note += gapNote(glm::distance(*ahead, nodeUv(pass.map, node)));
        }
        result.deadEnds.push_back({position, uvAt(cut->triangle, position), note});
    }
}

bool CuttingSurface::endsOnEdge(const Pass& pass, uint32_t triangle, const CutEnd& end,
                                uint32_t node) const {
    const uint32_t h = 3 * triangle + end.k;
    if (result.topology.opposite[h] == kNone || isUvSeam(result.topology, pass.frames, h))
        return false;
    const auto& corner = pass.frames[triangle].corner;
    const glm::dvec2 a(corner[end.k].u, corner[end.k].v);
    const glm::dvec2 b(corner[(end.k + 1) % 3].u, corner[(end.k + 1) % 3].v);
    const glm::dvec2 place = a + (b - a) * end.t.approximate();
    return glm::distance(place / double{kGridOne}, nodeUv(pass.map, node)) < 1e-9;
}

glm::dvec3 CuttingSurface::positionAt(uint32_t triangle, const UvTriangle& frame,
                                      const glm::dvec2& uv) const {
    std::array<glm::dvec2, 3> corner{};
    for (size_t k = 0; k < 3; ++k)
        corner[k] = glm::dvec2(frame.corner[k].u, frame.corner[k].v) / double{kGridOne};
    return pointOn(result.surface, triangle, weightsIn(uv, corner).value_or(glm::dvec3(1, 0, 0)));
}

std::optional<glm::dvec2> CuttingSurface::uvAt(uint32_t triangle,
                                               const glm::dvec3& position) const {
    return uvOf(mesh, result.surface.triangles[triangle].source, position);
}

Result<void> CuttingSurface::cutChords(std::span<const Chord> chords) {
    const Result<ChordCuts> cuts = cutsOfChords(chords);
    if (!cuts) return tl::unexpected(cuts.error());
    const std::vector<UvTriangle> frames(result.surface.triangles.size(), unitFrame());
    return cutAlong({cuts->map, frames, false, 0}, cuts->cuts);
}

}  // namespace sherd
