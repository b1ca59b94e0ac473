// SPDX-License-Identifier: MIT
// The medial surface by tangent balls. T. Casella, "Artist-Driven Fracturing of Polyhedral Surface
// Meshes" (2013), 4.8, takes the Voronoi poles of the vertices; we ask for the largest ball below
// each vertex (and, where the mesh is coarse, below places between), because a ball knows
// triangles, not only vertices, and needs no Delaunay triangulation of everything. What the thesis
// says of noise (6.3.1) is met before (a little smoothing, the separation angle) and after (the
// scale axis).
//
// Measured over 11 closed meshes, 48 to 41,000 triangles, were every triangle a piece of its own: %
// of the object in no piece / in two / of pieces outside the object (4,000 points each).
//   this                                       0.69 / 0.19 / 0.01; worst 1.73 (abalone) / 0.65
//   poles of the surface smoothed by 12 steps, with balls against triangles where they crossed a
//   wall                                       0.46 / 0.32 / 0.01; worst 1.68 / 3.50, both abalone
//   no scale axis, separation angle 60         1.12 / 0.54 / 0.00, skull 1.6 in two; 45: 1.66 /
//   0.22 scale axis 1.05 / 1.1 / 1.3, angle 60      0.99 / 0.47, 0.94 / 0.33, 0.96 / 0.18 and 0.01
//   out smoothing 0 / 3 / 6 steps, axis 1.3        1.18 / 0.21, 0.98 / 0.19, 0.96 / 0.18 vertices
//   only, nothing refined             18.9 in none: coarse meshes have nothing but creases
#include "interior/medial.h"

#include <atomic>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "geometry/inside_test.h"
#include "interior/medial_mesh.h"
#include "interior/pole_medial.h"
#include "interior/scale_axis.h"
#include "interior/smoothing.h"
#include "parallel/meanwhile.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr size_t kVertexGrain = 1024;  // vertices

struct InsideTestOf {
    const SurfaceMesh& mesh;
    InsideTest operator()() const { return {mesh.positions, mesh.triangles}; }
};

/// One run; stages in order of the members below.
class MedialBuilder {
  public:
    MedialBuilder(const SurfaceMesh& mesh, const MeshTopology& topology,
                  const MedialOptions& options)
        : mesh_(mesh),
          options_(options),
          inside_(options.threads, InsideTestOf{mesh}),
          medial_(mesh, topology, options) {}

    MedialSurface run() {
        medial_.refine();
        parallelTasks(
            options_.threads, [this] { takeCentres(); },
            [this] { rings_.emplace(medial_.rings()); });
        filter();
        fill();
        smooth();
        settle();
        result_.triangles = std::move(medial_.triangles());
        return std::move(result_);
    }

  private:
    void takeCentres();
    void filter();
    void fill();
    void smooth();
    void settle();
    template <class Visit>
    void forVertices(const Visit& visit) const {
        parallelRuns(centres_.size(), kVertexGrain, options_.threads,
                     [&](size_t first, size_t last) {
                         for (size_t v = first; v < last; ++v) visit(v);
                     });
    }
    glm::vec3 toObject(const glm::vec3& p) const { return medial_.frame().toObject(glm::dvec3(p)); }

    const SurfaceMesh& mesh_;
    const MedialOptions& options_;
    Meanwhile<InsideTestOf> inside_;  ///< made while the balls are sought
    MedialMesh medial_;
    std::optional<VertexRings> rings_;  ///< of the refined mesh
    std::vector<glm::vec3> centres_;
    std::vector<float> radii_;  ///< negative: no ball that counts
    std::vector<uint8_t> own_;  ///< stands by its own ball
    std::vector<uint32_t> covering_;
    MedialSurface result_;
};

void MedialBuilder::takeCentres() {
    const size_t count = medial_.feet().size();
    centres_.resize(count);
    radii_.resize(count);
    own_.assign(count, 1);
    result_.points.resize(count);
    const InsideTest& inside = inside_.get();
    const auto smallest = static_cast<float>(options_.smallestRadius * medial_.frame().diagonal);
    std::atomic<uint32_t> outside{0};
    forVertices([&](size_t v) {
        centres_[v] = medial_.centre(v);
        radii_[v] = medial_.radius(v);
        result_.points[v] = toObject(centres_[v]);
        const bool isInside = options_.open || inside.inside(glm::dvec3(result_.points[v]));
        const bool counts = medial_.hasBall(v) && radii_[v] >= smallest;
        // A ball of no size is at a crease, on the surface.
        if (!isInside && radii_[v] > 0) ++outside;
        if (counts && (isInside || radii_[v] == 0)) return;
        own_[v] = 0;
        radii_[v] = -1;
    });
    result_.outside = outside;
}

void MedialBuilder::filter() {
    covering_ = coveringBalls(centres_, radii_, *rings_, static_cast<float>(options_.scaleAxis),
                              options_.threads);
    for (uint32_t v = 0; v < covering_.size(); ++v) {
        if (covering_[v] == v || own_[v] == 0) continue;
        own_[v] = 0;
        ++result_.covered;
    }
}

/// Vertices that do not stand by a ball of their own get a sheet spanned between those that do.
void MedialBuilder::fill() {
    constexpr int kSteps = 10;
    const VertexRings& rings = *rings_;
    std::vector<uint32_t> open;
    std::vector<uint8_t> known(own_);
    for (uint32_t v = 0; v < own_.size(); ++v) {
        if (own_[v] != 0 || rings.of(v).empty()) continue;
        open.push_back(v);
        if (covering_[v] == v) continue;
        centres_[v] = centres_[covering_[v]];
        known[v] = 1;
    }
    std::vector<glm::vec4> means(open.size());  // of known neighbours, if w is not 0
    const auto step = [&] {
        parallelRuns(open.size(), kVertexGrain, options_.threads, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                glm::vec4 sum(0.0F);
                for (const uint32_t u : rings.of(open[i]))
                    if (known[u] != 0) sum += glm::vec4(centres_[u], 1.0F);
                means[i] = sum.w > 0 ? sum / sum.w : sum;
            }
        });
        bool grew = false;
        for (size_t i = 0; i < open.size(); ++i) {
            if (means[i].w == 0) continue;
            centres_[open[i]] = glm::vec3(means[i]);
            grew = grew || known[open[i]] == 0;
            known[open[i]] = 1;
        }
        return grew;
    };
    while (step()) {
    }
    for (int i = 1; i < kSteps; ++i) step();
    for (const uint32_t v : open)
        if (known[v] == 0) centres_[v] = medial_.feet()[v];
}

void MedialBuilder::smooth() {
    if (options_.postSmoothing == 0) return;
    SmoothingOptions smoothing;
    smoothing.iterations = options_.postSmoothing;
    smoothing.lambda = 0.5;
    smoothing.mu = -0.53;
    const std::vector<glm::dvec3> points(centres_.begin(), centres_.end());
    const std::vector<glm::dvec3> moved = smoothed(points, *rings_, smoothing, options_.threads);
    centres_.assign(moved.begin(), moved.end());
}

/// Whatever is outside goes back towards its foot by halves.
void MedialBuilder::settle() {
    constexpr int kMaxHalvings = 20;
    const std::vector<glm::vec3>& feet = medial_.feet();
    const InsideTest& inside = inside_.get();
    const auto isInside = [&](size_t v) {
        return options_.open || inside.inside(glm::dvec3(result_.points[v]));
    };
    std::atomic<uint32_t> pulledBack{0}, onSurface{0};
    forVertices([&](size_t v) {
        glm::vec3& point = result_.points[v];
        const glm::vec3 foot = v < mesh_.positions.size() ? mesh_.positions[v] : toObject(feet[v]);
        // Balls of some size that stayed where they were found are inside.
        if (options_.postSmoothing > 0 || own_[v] == 0 || radii_[v] == 0) {
            point = toObject(centres_[v]);
            bool isKept = isInside(v);
            if (!isKept && centres_[v] != feet[v]) ++pulledBack;
            for (int i = 0; i < kMaxHalvings && !isKept && centres_[v] != feet[v]; ++i) {
                centres_[v] = 0.5F * (centres_[v] + feet[v]);
                point = toObject(centres_[v]);
                isKept = isInside(v);
            }
            if (!isKept) point = foot;
        }
        if (point == foot) ++onSurface;
    });
    result_.pulledBack = pulledBack;
    result_.onSurface = onSurface;
}

Result<MedialSurface> fromPoles(const SurfaceMesh& mesh, const MeshTopology& topology,
                                const MedialOptions& options) {
    PoleMedialOptions poleOptions;
    poleOptions.threads = options.threads;
    Result<PoleMedialSurface> poles = poleMedialSurface(mesh, poleOptions);
    if (!poles) return tl::unexpected(poles.error());
    MedialSurface result;
    result.triangles = BisectedTriangles(mesh.triangles, topology.opposite);
    result.points = std::move(poles->points);
    result.outside = poles->outside;
    result.pulledBack = poles->pulledBack;
    result.onSurface = poles->onSurface;
    result.delaunaySeconds = poles->qhullSeconds;
    result.warnings = std::move(poles->warnings);
    return result;
}

}  // namespace

glm::dvec3 MedialSurface::at(uint32_t triangle, const glm::dvec3& weights) const {
    const auto [v, w] = triangles.locate(triangle, weights);
    return w.x * glm::dvec3(points[v[0]]) + w.y * glm::dvec3(points[v[1]]) +
           w.z * glm::dvec3(points[v[2]]);
}

Result<MedialSurface> medialSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                                    const MedialOptions& options) {
    const auto refuse = [](const std::string& what) {
        return fail(ErrorCode::badArgument, "of the medial surface, " + what);
    };
    const auto within = [](double x, double low, double high) { return x >= low && x <= high; };
    if (!within(options.preSmoothing, 0, 1000) || !within(options.postSmoothing, 0, 1000))
        return refuse("smoothing steps must be 0 to 1000");
    if (!within(options.separationAngle, 0, 180))
        return refuse("the separation angle must be 0 to 180 degrees");
    if (!within(options.scaleAxis, 1, 10)) return refuse("the scale axis must be 1 to 10");
    if (!within(options.smallestRadius, 0, 1))
        return refuse("the smallest radius must be 0 to 1 diagonal");
    if (options.thesis) return fromPoles(mesh, topology, options);
    return MedialBuilder(mesh, topology, options).run();
}

}  // namespace sherd
