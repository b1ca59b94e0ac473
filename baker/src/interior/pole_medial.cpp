// SPDX-License-Identifier: MIT
// The medial surface by Voronoi poles (Amenta and Bern 1999) of the smoothed surface, smoothed
// again: T. Casella, "Artist-Driven Fracturing of Polyhedral Surface Meshes" (2013), 4.8. Where we
// deviate: points that smoothing has carried out of the solid go back towards their vertex.
#include "interior/pole_medial.h"

#include <chrono>
#include <optional>

#include "geometry/inside_test.h"
#include "geometry/voronoi.h"
#include "interior/poles.h"
#include "interior/smoothing.h"
#include "interior/unit_frame.h"
#include "interior/vertex_normals.h"
#include "interior/vertex_rings.h"
#include "surface/mesh_topology.h"

namespace sherd {
namespace {

/// One run; stages in order of the members below.
class PoleMedialBuilder {
  public:
    PoleMedialBuilder(const SurfaceMesh& mesh, const PoleMedialOptions& options)
        : mesh_(mesh),
          options_(options),
          rings_(mesh.positions.size(), mesh.triangles,
                 buildTopology(mesh.positions, mesh.triangles).opposite),
          frame_(mesh),
          used_(mesh.positions.size(), 0) {
        unit_.reserve(mesh.positions.size());
        for (const glm::vec3& p : mesh.positions) unit_.push_back(frame_.toUnit(glm::dvec3(p)));
        for (const auto& t : mesh.triangles) {
            for (const uint32_t v : t) used_[v] = 1;
        }
    }

    PoleMedialSurface run() {
        findPoles();
        smoothPoles();
        pullInside();
        return std::move(result_);
    }

  private:
    void findPoles();
    void smoothPoles();
    void pullInside();

    const SurfaceMesh& mesh_;
    const PoleMedialOptions& options_;
    VertexRings rings_;
    UnitFrame frame_;
    std::vector<glm::dvec3> unit_;                  ///< positions in the unit frame
    std::vector<uint8_t> used_;                     ///< has a triangle
    std::vector<std::optional<glm::dvec3>> poles_;  ///< unit frame; none: no pole on the inner side
    PoleMedialSurface result_;
};

void PoleMedialBuilder::findPoles() {
    poles_.assign(unit_.size(), std::nullopt);
    SmoothingOptions smoothing;
    smoothing.iterations = options_.preSmoothing;
    const std::vector<glm::dvec3> surface = smoothed(unit_, rings_, smoothing, options_.threads);
    const std::vector<glm::dvec3> normals = vertexNormals(
        facetsOf(surface, mesh_.triangles, options_.threads),
        VertexCorners(surface.size(), mesh_.triangles), surface.size(), options_.threads);
    std::vector<glm::dvec3> sites, siteNormals;
    std::vector<uint32_t> vertexOfSite;
    for (uint32_t v = 0; v < surface.size(); ++v) {
        if (used_[v] == 0) continue;
        sites.push_back(surface[v]);
        siteNormals.push_back(normals[v]);
        vertexOfSite.push_back(v);
    }
    const auto start = std::chrono::steady_clock::now();
    const Result<VoronoiVertices> voronoi = voronoiVertices(sites);
    const auto end = std::chrono::steady_clock::now();
    result_.qhullSeconds = std::chrono::duration<double>(end - start).count();
    if (!voronoi) {
        result_.warnings.push_back("no medial poles: " + voronoi.error().message);
        return;
    }
    const std::vector<uint32_t> poles =
        innerPoles(sites, siteNormals, *voronoi, frame_.diagonal / 2);
    for (uint32_t s = 0; s < sites.size(); ++s) {
        if (poles[s] != kNoPole) poles_[vertexOfSite[s]] = voronoi->points[poles[s]];
    }
}

void PoleMedialBuilder::smoothPoles() {
    SmoothingOptions smoothing;
    smoothing.iterations = options_.postSmoothing;
    std::vector<glm::dvec3> points(unit_);
    for (size_t v = 0; v < points.size(); ++v) points[v] = poles_[v].value_or(unit_[v]);
    points = smoothed(points, rings_, smoothing, options_.threads);
    for (size_t v = 0; v < points.size(); ++v) {
        if (poles_[v]) poles_[v] = points[v];
    }
}

void PoleMedialBuilder::pullInside() {
    constexpr int kMaxHalvings = 20;  // 1e-6 of the way
    const InsideTest insideTest(mesh_.positions, mesh_.triangles);
    std::vector<glm::vec3>& points = result_.points;
    points = mesh_.positions;
    for (size_t v = 0; v < points.size(); ++v) {
        if (poles_[v]) points[v] = frame_.toObject(*poles_[v]);
    }
    std::vector<uint8_t> inside(points.size());
    insideTest.inside(points, inside, options_.threads);
    for (size_t v = 0; v < points.size(); ++v) {
        bool isInside = poles_[v] && inside[v] != 0;
        if (used_[v] != 0 && !isInside) ++result_.outside;
        for (int i = 0; i < kMaxHalvings && !isInside && poles_[v]; ++i) {
            *poles_[v] = unit_[v] + (*poles_[v] - unit_[v]) / 2.0;
            points[v] = frame_.toObject(*poles_[v]);
            isInside = points[v] != mesh_.positions[v] && insideTest.inside(glm::dvec3(points[v]));
            if (isInside) ++result_.pulledBack;
        }
        if (isInside) continue;
        points[v] = mesh_.positions[v];
        ++result_.onSurface;
    }
}

}  // namespace

Result<PoleMedialSurface> poleMedialSurface(const SurfaceMesh& mesh,
                                            const PoleMedialOptions& options) {
    const auto inRange = [](int steps) { return steps >= 0 && steps <= 1000; };
    if (!inRange(options.preSmoothing) || !inRange(options.postSmoothing)) {
        return fail(ErrorCode::badArgument,
                    "smoothing steps of the medial surface must be 0 to 1000");
    }
    return PoleMedialBuilder(mesh, options).run();
}

}  // namespace sherd
