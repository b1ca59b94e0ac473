// SPDX-License-Identifier: MIT
// The medial surface by Voronoi poles (Amenta and Bern 1999) of the smoothed surface, after
// T. Casella, "Artist-Driven Fracturing of Polyhedral Surface Meshes" (2013), 4.8. Smoothing first
// removes the fine detail whose medial branches would make the sheet jagged. Where we deviate: no
// smoothing of the poles afterwards, and a ladder for poles that are outside the original solid:
// the mean of the neighbours' inner points (keeps the sheet whole), else the tangent ball of the
// original surface, else half the way back to the vertex, a quarter..., else the vertex itself.
// And poles only know vertices: those whose balls cross a triangle give way to tangent balls.
//
// What that is worth, over 18 meshes and on the shell of an abalone, thinner than its vertices are
// apart. If every triangle were a piece: % of the object in no piece / in two / of pieces outside
// the object (20,000 points each), and % of the surface whose prism is inverted.
//                                       mean of all          abalone
//   poles only                          0.71 / 0.36 / 2.32   3.75 / 1.81 / 39.4, 22.7 inverted
//   this                                0.52 / 0.30 / 0.08   1.75 / 3.40 / 0.06,  0.3 inverted
//   never balls of the original wall    0.52 / 0.16 / 3.32   2.21 / 1.08 / 59.1, 26.3 inverted
//   those at creases too                1.84 / 0.46 / 0.13   2.16 / 3.21 / 0.01,  0.2 inverted;
//                                       a coarse wall with a window: 23 instead of 0.85 in none
//   their normals not smoothed          0.49 / 0.44 / 0.07   1.72 / 3.77 / 0.01,  0.2 inverted
// Of 108 pieces drawn on the abalone 33 had been inside out and 32 of them were merged: now none.
// In no piece were 7.6 %, now 1.8 %, in two 0.6 %, now 1.2 %; pieces stuck out by 5.8 % of the
// diagonal, now by 0.35 %.
//
// Poles only, 16 meshes (48 to 59,664 triangles, 4 of them open), % in no piece / in two:
//   this: 12 steps                              0.68 % / 0.29 %
//   10 steps 0.79 / 0.34, 15 steps 0.56 / 0.31, 20 steps 2.41 / 0.22 (one pillar of many small
//   parts alone goes from 0.3 to 31 %), 30 steps 0.53 / 0.34; more steps, more inverted prisms
//   the thesis' 10 before and 10 after          4.0 % / 0.03 %
// With 10 steps and the neighbours' mean:
//   balls along the normal instead of poles     0.55 % / 0.87 %, worse on scans (skull 1.4 / 0.2)
//   only poles with clearance >= 0.1 radius     2.7 % / 0.3 %
// With 10 steps and the tangent ball instead of the neighbours' mean 1.44 % / 0.84 %, and then with
// poles sought only among the inner Voronoi vertices 1.05 % / 0.55 %; compared to the latter:
//   cotangent weights 1.65 / 0.98, Taubin instead of Laplace 4.2 / 1.4, no smoothing 9.1 / 0.6
// Skull (41,000 triangles): 0.77 % / 0.00 %; 330 ms in Qhull and 60 ms of the rest, one thread, to
// which the search for crossed triangles adds about a quarter of Qhull's time.
#include "interior/medial.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "geometry/voronoi.h"
#include "interior/poles.h"
#include "interior/smoothing.h"
#include "interior/tangent_ball.h"
#include "interior/wall_balls.h"

namespace sherd {
namespace {

constexpr int kThesisSteps = 10;

/// The mesh moved and scaled to a box of size 1 around the origin, by a power of two: input scaled
/// by a power of two gives the same bits here.
struct UnitFrame {
    glm::dvec3 centre{0};
    int exponent = 0;     ///< one unit is 2^exponent
    double diagonal = 0;  ///< of the bounding box, in units

    explicit UnitFrame(const SurfaceMesh& mesh) {
        glm::dvec3 low(0), high(0);
        bool first = true;
        for (const auto& t : mesh.triangles) {
            for (const uint32_t v : t) {
                const glm::dvec3 p(mesh.positions[v]);
                low = first ? p : glm::min(low, p);
                high = first ? p : glm::max(high, p);
                first = false;
            }
        }
        const glm::dvec3 size = high - low;
        centre = low + size / 2.0;
        std::frexp(std::max({size.x, size.y, size.z}), &exponent);
        diagonal = std::ldexp(glm::length(size), -exponent);
    }
    glm::dvec3 toUnit(const glm::vec3& p) const {
        return (glm::dvec3(p) - centre) * std::ldexp(1.0, -exponent);
    }
    glm::vec3 toObject(const glm::dvec3& p) const {
        return glm::vec3(centre + p * std::ldexp(1.0, exponent));
    }
};

/// One run; stages in order of the members below.
class MedialBuilder {
  public:
    MedialBuilder(const SurfaceMesh& mesh, const MedialOptions& options)
        : mesh_(mesh),
          options_(options),
          frame_(mesh),
          insideTest_(mesh.positions, mesh.triangles) {
        unit_.reserve(mesh.positions.size());
        for (const glm::vec3& p : mesh.positions) unit_.push_back(frame_.toUnit(p));
        used_.assign(unit_.size(), 0);
        for (const auto& t : mesh.triangles) {
            for (const uint32_t v : t) used_[v] = 1;
        }
    }

    MedialSurface run() {
        findPoles();
        smoothMedial();
        mend();
        return std::move(result_);
    }

  private:
    void findPoles();
    void smoothMedial();
    void mend();
    void fillFromNeighbours();
    void mendOneByOne();
    glm::vec3 mended(uint32_t v);
    std::optional<glm::vec3> pulledBack(uint32_t v, glm::dvec3 point);
    void shrinkThroughWalls(const std::vector<glm::dvec3>& surface,
                            const std::vector<glm::dvec3>& normals);
    bool inSolid(const glm::dvec3& point) {
        return insideTest_.inside(glm::dvec3(frame_.toObject(point)));
    }

    /// What balls of the original surface need; made for the first of them.
    struct Original {
        TriangleBvh bvh;
        std::vector<glm::dvec3> normals;  ///< smoothed a little: noise would tilt the balls
    };
    const Original& original();
    double originalRadius(uint32_t v);
    std::optional<glm::dvec3> ballInFlatWall(uint32_t v);

    const SurfaceMesh& mesh_;
    const MedialOptions& options_;
    UnitFrame frame_;
    InsideTest insideTest_;
    std::vector<glm::dvec3> unit_;                  ///< positions in the unit frame
    std::vector<uint8_t> used_;                     ///< has a triangle
    std::vector<std::optional<glm::dvec3>> poles_;  ///< unit frame; none: no pole on the inner side
    std::vector<uint8_t> good_;                     ///< has an inner point
    std::optional<Original> original_;
    MedialSurface result_;
};

void MedialBuilder::findPoles() {
    poles_.assign(unit_.size(), std::nullopt);
    SmoothingOptions smoothing;
    smoothing.iterations = options_.thesis ? kThesisSteps : options_.preSmoothing;
    const std::vector<glm::dvec3> surface = smoothed(unit_, mesh_.triangles, smoothing);
    const std::vector<glm::dvec3> normals = vertexNormals(surface, mesh_.triangles);
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
        result_.warnings.push_back("no medial poles, tangent balls instead: " +
                                   voronoi.error().message);
        return;
    }
    const std::vector<uint32_t> poles =
        innerPoles(sites, siteNormals, *voronoi, frame_.diagonal / 2);
    for (uint32_t s = 0; s < sites.size(); ++s) {
        if (poles[s] != kNoPole) poles_[vertexOfSite[s]] = voronoi->points[poles[s]];
    }
    if (!options_.thesis) shrinkThroughWalls(surface, normals);
}

/// Balls that reach through a wall are shrunk on the smoothed surface first; if smoothing has moved
/// the wall off itself, on the original one.
void MedialBuilder::shrinkThroughWalls(const std::vector<glm::dvec3>& surface,
                                       const std::vector<glm::dvec3>& normals) {
    const WallSurface wall{surface, mesh_.triangles, normals};
    const auto centres = ballsBetweenWalls(wall, poles_, options_.threads);
    for (uint32_t v = 0; v < centres.size(); ++v) {
        if (!centres[v]) continue;
        ++result_.throughWalls;
        poles_[v] = inSolid(*centres[v]) ? centres[v] : ballInFlatWall(v);
    }
}

const MedialBuilder::Original& MedialBuilder::original() {
    if (!original_) {
        SmoothingOptions little;
        little.iterations = 4;
        original_.emplace(
            Original{TriangleBvh(mesh_.positions, mesh_.triangles),
                     vertexNormals(smoothed(unit_, mesh_.triangles, little), mesh_.triangles)});
    }
    return *original_;
}

/// Of the tangent ball at v, in units; v must have a normal.
double MedialBuilder::originalRadius(uint32_t v) {
    const double unit = std::ldexp(1.0, frame_.exponent);
    return tangentBallRadius(original().bvh, mesh_.triangles, v, glm::dvec3(mesh_.positions[v]),
                             original().normals[v], frame_.diagonal / 2 * unit) /
           unit;
}

/// The centre of the original surface's ball at v, where v is no crease: at one the triangles
/// around v cut into the ball, and the neighbours' mean is better.
std::optional<glm::dvec3> MedialBuilder::ballInFlatWall(uint32_t v) {
    constexpr double kFlat = 0.98;  // of the radius
    const glm::dvec3 normal = original().normals[v];
    if (!(glm::dot(normal, normal) > 0)) return std::nullopt;
    const double radius = originalRadius(v);
    const glm::dvec3 centre = unit_[v] - radius * normal;
    if (!inSolid(centre)) return std::nullopt;
    const double reach = std::ldexp(kFlat * radius, frame_.exponent);
    const glm::dvec3 point(frame_.toObject(centre));
    if (original().bvh.closest(point, reach).triangle != ClosestPoint::kNone) return std::nullopt;
    ++result_.ballsInWalls;
    return centre;
}

void MedialBuilder::smoothMedial() {
    SmoothingOptions smoothing;
    smoothing.iterations = options_.thesis ? kThesisSteps : options_.postSmoothing;
    if (smoothing.iterations == 0) return;
    if (!options_.thesis) {
        smoothing.lambda = 0.5;
        smoothing.mu = -0.53;
    }
    std::vector<glm::dvec3> points(unit_);
    for (size_t v = 0; v < points.size(); ++v) points[v] = poles_[v].value_or(unit_[v]);
    points = smoothed(points, mesh_.triangles, smoothing);
    for (size_t v = 0; v < points.size(); ++v) {
        if (poles_[v]) poles_[v] = points[v];
    }
}

void MedialBuilder::mend() {
    std::vector<glm::vec3>& points = result_.points;
    points = mesh_.positions;
    for (size_t v = 0; v < points.size(); ++v) {
        if (poles_[v]) points[v] = frame_.toObject(*poles_[v]);
    }
    good_.resize(points.size());
    insideTest_.inside(points, good_, options_.threads);
    for (size_t v = 0; v < points.size(); ++v) {
        if (!poles_[v]) good_[v] = 0;
        if (used_[v] == 0) ++result_.onSurface;
        if (used_[v] != 0 && good_[v] == 0) ++result_.outsideBefore;
    }
    if (result_.outsideBefore > 0) {
        if (!options_.thesis) fillFromNeighbours();
        mendOneByOne();
    }
    std::vector<uint8_t> inside(points.size());
    insideTest_.inside(points, inside, options_.threads);
    for (size_t v = 0; v < points.size(); ++v) {
        if (inside[v] == 0 && points[v] != mesh_.positions[v]) ++result_.outsideAfter;
    }
}

/// Vertices without an inner point take the mean of their neighbours' where that is inside, ring by
/// ring from the rim of the gap.
void MedialBuilder::fillFromNeighbours() {
    std::vector<std::array<uint32_t, 3>> around;  // triangles with such a vertex
    for (const auto& t : mesh_.triangles) {
        if (good_[t[0]] == 0 || good_[t[1]] == 0 || good_[t[2]] == 0) around.push_back(t);
    }
    std::map<uint32_t, std::pair<glm::dvec3, int>> sums;
    for (bool changed = true; changed;) {
        changed = false;
        sums.clear();
        for (const auto& t : around) {
            for (int k = 0; k < 6; ++k) {
                const uint32_t to = t[k % 3], from = t[(k + 1 + k / 3) % 3];
                if (good_[to] != 0 || good_[from] == 0) continue;
                auto& [sum, count] = sums.try_emplace(to, glm::dvec3(0.0), 0).first->second;
                sum += frame_.toUnit(result_.points[from]);
                ++count;
            }
        }
        for (const auto& [v, sum] : sums) {
            const glm::vec3 mean = frame_.toObject(sum.first / static_cast<double>(sum.second));
            if (!insideTest_.inside(glm::dvec3(mean))) continue;
            result_.points[v] = mean;
            good_[v] = 1;
            ++result_.fromNeighbours;
            changed = true;
        }
    }
}

void MedialBuilder::mendOneByOne() {
    for (uint32_t v = 0; v < unit_.size(); ++v) {
        if (good_[v] == 0 && used_[v] != 0) result_.points[v] = mended(v);
    }
}

/// The ball of the original surface at v, or the nearest point on the way to it (or to the pole, as
/// the thesis has it) that is inside.
glm::vec3 MedialBuilder::mended(uint32_t v) {
    const glm::dvec3 normal = options_.thesis ? glm::dvec3(0.0) : original().normals[v];
    if (glm::dot(normal, normal) > 0) {
        const glm::dvec3 centre = unit_[v] - originalRadius(v) * normal;
        if (inSolid(centre)) {
            ++result_.fallbackRaw;
            return frame_.toObject(centre);
        }
        if (const auto back = pulledBack(v, centre)) return *back;
    }
    if (poles_[v]) {
        if (const auto back = pulledBack(v, *poles_[v])) return *back;
    }
    ++result_.onSurface;
    return mesh_.positions[v];
}

std::optional<glm::vec3> MedialBuilder::pulledBack(uint32_t v, glm::dvec3 point) {
    constexpr int kMaxHalvings = 20;  // 1e-6 of the way
    for (int i = 0; i < kMaxHalvings; ++i) {
        point = unit_[v] + (point - unit_[v]) / 2.0;
        const glm::vec3 rounded = frame_.toObject(point);
        if (rounded == mesh_.positions[v]) return std::nullopt;
        if (insideTest_.inside(glm::dvec3(rounded))) {
            ++result_.pulledBack;
            return rounded;
        }
    }
    return std::nullopt;
}

}  // namespace

Result<MedialSurface> medialSurface(const SurfaceMesh& mesh, const MedialOptions& options) {
    const auto inRange = [](int steps) { return steps >= 0 && steps <= 1000; };
    if (!inRange(options.preSmoothing) || !inRange(options.postSmoothing)) {
        return fail(ErrorCode::badArgument,
                    "smoothing steps of the medial surface must be 0 to 1000");
    }
    return MedialBuilder(mesh, options).run();
}

}  // namespace sherd
