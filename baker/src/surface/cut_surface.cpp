// SPDX-License-Identifier: MIT
#include "surface/cut_surface.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangle.h"
#include "surface/components.h"
#include "surface/thesis_pairing.h"
#include "surface/triangulation.h"

namespace sherd {
namespace {

/// Where lines end in the middle of the surface.
std::vector<glm::dvec2> deadEnds(const PlanarMap& map, std::span<const Cut> cuts) {
    std::vector<uint32_t> degree(map.nodes.size(), 0);
    for (const MapEdge& edge : map.edges) {
        ++degree[edge.from];
        ++degree[edge.to];
    }
    std::vector<uint32_t> nodes;
    for (const Cut& cut : cuts) {
        for (const CutEnd& end : {cut.from, cut.to}) {
            if (end.where == CutEnd::Where::inside && degree[end.node] == 1)
                nodes.push_back(end.node);
        }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<glm::dvec2> places;
    places.reserve(nodes.size());
    for (const uint32_t node : nodes) places.push_back(nodeUv(map, node));
    return places;
}

}  // namespace

Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FractureMap& map, const SeamOptions& options) {
    const Result<std::vector<UvTriangle>> uv = snapUv(mesh);
    if (!uv) return tl::unexpected(uv.error());
    Result<PlanarMap> planar = planarise(map);
    if (!planar) return tl::unexpected(planar.error());
    std::vector<Cut> cuts = matchAll(*planar, *uv, topology.degenerate);
    std::vector<Cut> unmoved;
    uint32_t averaged = 0;
    const auto cutAlong = [&](std::span<const Cut> chosen, CutSurface& result) {
        ResolvedEdges edges = resolveEdges(topology, mesh.triangles,
                                           static_cast<uint32_t>(mesh.positions.size()), chosen);
        result.seams =
            joinAcrossSeams(topology, mesh.positions, mesh.triangles, *uv, chosen, options, edges);
        return splitSurface(
            {mesh.positions, mesh.triangles, topology, *uv, *planar, chosen, edges});
    };
    CutSurface result;
    result.warnings = std::move(planar->warnings);
    if (options.thesisPairing) {
        unmoved = cuts;
        averaged = averageSeamPairs(topology, mesh.triangles, *uv, cuts);
    }
    Result<SplitSurface> split = cutAlong(cuts, result);
    if (!split && options.thesisPairing) {
        // A moved end may drag its line over another.
        result.warnings.emplace_back(
            "averaging line ends at seams made lines cross; it was left out");
        averaged = 0;
        split = cutAlong(unmoved, result);
    }
    if (!split) return tl::unexpected(split.error());
    result.seams.averaged = averaged;
    result.deadEnds = deadEnds(*planar, cuts);
    result.surface = std::move(*split);
    result.topology = buildTopology(result.surface.positions, vertexTriangles(result.surface));
    return result;
}

bool isFaithfulSplit(const SurfaceMesh& mesh, const MeshTopology& before, const CutSurface& cut,
                     double tolerance) {
    std::vector<double> area(mesh.triangles.size(), 0);
    double total = 0;
    double reach = 0;  // a coordinate is off by 2^-24 of its size, an area by that times an edge
    for (const SplitTriangle& t : cut.surface.triangles)
        area[t.source] += triangleArea(cut.surface.positions, t.v);
    for (const glm::vec3& p : mesh.positions) {
        reach =
            std::max({reach, std::abs(double{p.x}), std::abs(double{p.y}), std::abs(double{p.z})});
    }
    for (size_t t = 0; t < area.size(); ++t) {
        if (before.degenerate[t] == 0) total += triangleArea(mesh.positions, mesh.triangles[t]);
    }
    for (size_t t = 0; t < area.size(); ++t) {
        if (before.degenerate[t] != 0) continue;
        const double whole = triangleArea(mesh.positions, mesh.triangles[t]);
        const double rounding = 1e-6 * reach * std::sqrt(total);
        if (std::abs(area[t] - whole) > tolerance * total + rounding) return false;
    }
    for (const VertexOrigin& origin : cut.surface.origins) {
        const glm::dvec3& w = origin.weights;
        if (w.x < 0 || w.y < 0 || w.z < 0 || std::abs(w.x + w.y + w.z - 1) > 1e-12) return false;
    }
    if (before.boundaryEdges + before.nonManifoldEdges > 0) return true;
    return cut.topology.boundaryEdges + cut.topology.nonManifoldEdges == 0;
}

}  // namespace sherd
