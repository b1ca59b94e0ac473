// SPDX-License-Identifier: MIT
#include "surface/cut_surface.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/triangle.h"
#include "surface/components.h"
#include "surface/thesis_pairing.h"
#include "surface/triangulation.h"

namespace sherd {
namespace {

/// One object's cutting: the surface as cut so far, and what there is to say.
class SurfaceCutter {
  public:
    SurfaceCutter(const SurfaceMesh& mesh, const MeshTopology& topology, const FracturePlan& plan,
                  const CutOptions& options)
        : mesh_(mesh), plan_(plan), options_(options) {
        result_.surface = uncutSurface(mesh);
        result_.topology = topology;
    }

    Result<CutSurface> run() {
        numberLines();
        if (auto ok = cutDrawings(); !ok) return tl::unexpected(ok.error());
        return std::move(result_);
    }

  private:
    /// A drawing's lines, or those of several, and their marks.
    struct Page {
        FractureMap map;
        std::vector<uint32_t> marks;
    };

    void numberLines() {
        std::vector<LineTable::Line> lines;
        for (const FracturePlan::Drawing& drawing : plan_.drawings) {
            for (const FractureMap::Line& line : drawing.map.lines)
                lines.push_back({line.level, line.properties, line.source});
        }
        marks_ = result_.lines.assign(std::move(lines));
    }

    /// Drawings in UV share one frame and so one cut.
    Result<void> cutDrawings() {
        Page uv;
        size_t line = 0;
        for (const FracturePlan::Drawing& drawing : plan_.drawings) {
            for (const FractureMap::Line& drawn : drawing.map.lines) {
                uv.map.lines.push_back(drawn);
                uv.marks.push_back(marks_[line++]);
            }
        }
        if (uv.map.lines.empty()) return {};
        const Result<std::vector<UvTriangle>> frames = snapUv(mesh_);
        if (!frames) return tl::unexpected(frames.error());
        return cutPage(uv, *frames);
    }

    Result<void> cutPage(const Page& page, std::span<const UvTriangle> frames) {
        Result<PlanarMap> planar = planarise(page.map);
        if (!planar) return tl::unexpected(planar.error());
        result_.warnings.insert(result_.warnings.end(), planar->warnings.begin(),
                                planar->warnings.end());
        std::vector<Cut> cuts = matchAll(*planar, page.marks, frames, result_.topology.degenerate);
        if (!options_.seams.thesisPairing) return cutAlong(*planar, frames, cuts);

        const std::vector<Cut> unmoved = cuts;
        const uint32_t averaged =
            averageSeamPairs(result_.topology, result_.surface.triangles, frames, cuts);
        if (cutAlong(*planar, frames, cuts)) {
            result_.seams.averaged += averaged;
            return {};
        }
        // A moved end may drag its line over another.
        result_.warnings.emplace_back(
            "averaging line ends at seams made lines cross; it was left out");
        return cutAlong(*planar, frames, unmoved);
    }

    Result<void> cutAlong(const PlanarMap& map, std::span<const UvTriangle> frames,
                          std::span<const Cut> cuts) {
        ResolvedEdges edges = resolveEdges(result_.topology, result_.surface, cuts);
        SeamReport seams = joinAcrossSeams(result_.topology, result_.surface, frames, cuts,
                                           result_.lines, options_.seams, edges);
        SplitInput input{result_.surface, result_.topology, frames, map, cuts, edges};
        Result<SplitSurface> split = splitSurface(input);
        if (!split) return tl::unexpected(split.error());
        findDeadEnds(map, frames, cuts);
        result_.surface = std::move(*split);
        result_.topology =
            buildTopology(result_.surface.positions, vertexTriangles(result_.surface));
        result_.seams.joined += seams.joined;
        result_.seams.loose.insert(result_.seams.loose.end(), seams.loose.begin(),
                                   seams.loose.end());
        return {};
    }

    /// Where lines end in the middle of the surface.
    void findDeadEnds(const PlanarMap& map, std::span<const UvTriangle> frames,
                      std::span<const Cut> cuts) {
        std::vector<uint32_t> degree(map.nodes.size(), 0);
        for (const MapEdge& edge : map.edges) {
            ++degree[edge.from];
            ++degree[edge.to];
        }
        std::map<uint32_t, uint32_t> triangleOfNode;
        for (const Cut& cut : cuts) {
            for (const CutEnd& end : {cut.from, cut.to}) {
                if (end.where == CutEnd::Where::inside && degree[end.node] == 1)
                    triangleOfNode.try_emplace(end.node, cut.triangle);
            }
        }
        for (const auto& [node, triangle] : triangleOfNode) {
            const glm::dvec2 uv = nodeUv(map, node);
            result_.deadEnds.push_back({positionAt(triangle, frames[triangle], uv), uv});
        }
    }

    /// The place of the frame's point on the triangle.
    glm::dvec3 positionAt(uint32_t triangle, const UvTriangle& frame, const glm::dvec2& uv) const {
        const auto at = [&](size_t k) {
            return glm::dvec2(frame.corner[k].u, frame.corner[k].v) / double{kGridOne};
        };
        const auto area = [](glm::dvec2 x, glm::dvec2 y) { return x.x * y.y - x.y * y.x; };
        const double whole = area(at(1) - at(0), at(2) - at(0));
        const double b = whole == 0 ? 0 : area(uv - at(0), at(2) - at(0)) / whole;
        const double c = whole == 0 ? 0 : area(at(1) - at(0), uv - at(0)) / whole;
        const auto& v = result_.surface.triangles[triangle].v;
        return glm::dvec3(result_.surface.positions[v[0]]) * (1 - b - c) +
               glm::dvec3(result_.surface.positions[v[1]]) * b +
               glm::dvec3(result_.surface.positions[v[2]]) * c;
    }

    const SurfaceMesh& mesh_;
    const FracturePlan& plan_;
    const CutOptions& options_;
    std::vector<uint32_t> marks_;  ///< of all lines in the order of their sources
    CutSurface result_;
};

}  // namespace

Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FracturePlan& plan, const CutOptions& options) {
    return SurfaceCutter(mesh, topology, plan, options).run();
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
