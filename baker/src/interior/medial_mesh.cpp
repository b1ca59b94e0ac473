// SPDX-License-Identifier: MIT
#include "interior/medial_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "geometry/edge_refinement.h"
#include "interior/smoothing.h"
#include "interior/vertex_balls.h"
#include "interior/vertex_normals.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr size_t kFootGrain = 2048;

glm::vec3 unitOrZero(const glm::dvec3& n) {
    const double length = glm::length(n);
    return length > 1e-6 ? glm::vec3(n / length) : glm::vec3(0.0F);
}

std::vector<glm::dvec3> inUnits(const SurfaceMesh& mesh, const UnitFrame& frame) {
    std::vector<glm::dvec3> unit;
    unit.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) unit.push_back(frame.toUnit(glm::dvec3(p)));
    return unit;
}

struct SmoothSurface {
    std::vector<glm::dvec3> points;
    std::vector<Facet> facets;
};

/// Smoothing that moves points along the surface would only tell balls of other places: what counts
/// is how far it moves them along their normals.
SmoothSurface smoothedSurface(const SurfaceMesh& mesh, const std::vector<glm::dvec3>& feet,
                              const VertexRings& rings, const VertexCorners& corners,
                              double diagonal, const MedialOptions& options) {
    SmoothingOptions smoothing;
    smoothing.iterations = options.preSmoothing;
    smoothing.reach = options.smoothingReach * diagonal;
    SmoothSurface result{smoothed(feet, rings, smoothing, options.threads), {}};
    // Which way is all that counts here: the sum of the triangles' areas will do.
    const auto normalAt = [&](uint32_t v) {
        glm::dvec3 sum(0.0);
        for (const uint32_t c : corners.of(v)) {
            const auto& [a, b, d] = mesh.triangles[c / 3];
            const glm::dvec3 &p = result.points[a], &q = result.points[b], &r = result.points[d];
            sum += glm::cross(q - p, r - p);
        }
        return sum;
    };
    std::vector<glm::dvec3> moved(feet.size());
    parallelRuns(feet.size(), kFootGrain, options.threads, [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            const glm::dvec3 n = normalAt(static_cast<uint32_t>(v));
            const double length2 = glm::dot(n, n);
            const double along =
                length2 > 0 ? glm::dot(n, result.points[v] - feet[v]) / length2 : 0;
            moved[v] = feet[v] + n * along;
        }
    });
    result.points = std::move(moved);
    result.facets = facetsOf(result.points, mesh.triangles, options.threads);
    return result;
}

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

}  // namespace

MedialMesh::MedialMesh(const SurfaceMesh& mesh, const MeshTopology& topology,
                       const MedialOptions& options)
    : mesh_(mesh), options_(options), corners_(0, {}), tree_({}, {}, {}, 0) {
    const size_t count = mesh.positions.size();
    const size_t room = count + count / 2;  // refinement adds some
    std::vector<glm::dvec3> feet;
    VertexRings around(0, {}, {});
    parallelTasks(
        options.threads, [&] { triangles_ = BisectedTriangles(mesh.triangles, topology.opposite); },
        [&] { around = VertexRings(count, mesh.triangles, topology.opposite); },
        [&] { corners_ = VertexCorners(count, mesh.triangles); },
        [&] {
            frame_ = UnitFrame(mesh);
            feet = inUnits(mesh, frame_);
            feet_.reserve(room);
            feet_.assign(feet.begin(), feet.end());
            origins_.reserve(room);
            origins_.resize(count);
            for (uint32_t v = 0; v < count; ++v) origins_[v].vertices = {v, v, v};
        });
    SmoothSurface surface = smoothedSurface(mesh, feet, around, corners_, frame_.diagonal, options);
    vertexNormals_ = vertexNormals(surface.facets, corners_, count, options.threads);
    facets_ = std::move(surface.facets);
    smoothed_.resize(count);
    tangents_.reserve(room);
    tangents_.resize(count);
    parallelRuns(count, kFootGrain, options.threads, [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            smoothed_[v] = glm::vec3(surface.points[v]);
            tangents_[v] = {smoothed_[v], glm::vec3(vertexNormals_[v])};
        }
    });
    const double angle = radians(options.separationAngle);
    tree_ = BallTree(smoothed_, mesh.triangles, topology.opposite, angle, options.threads);
    balls_ = vertexBalls(tree_, mesh.triangles, tangents_, around,
                         static_cast<float>(frame_.diagonal / 2), options.threads);
    balls_.reserve(room);
}

std::array<uint32_t, 2> MedialMesh::endsOf(uint32_t halfEdge) const {
    const auto& v = triangles_.triangles[halfEdge / 3].v;
    return {v[halfEdge % 3], v[(halfEdge + 1) % 3]};
}

double MedialMesh::length2(uint32_t halfEdge) const {
    const auto [a, b] = endsOf(halfEdge);
    const glm::vec3 d = feet_[a] - feet_[b];
    return glm::dot(d, d);
}

MedialMesh::Middle MedialMesh::middleOf(uint32_t halfEdge) const {
    const std::array<uint32_t, 2> ends = endsOf(halfEdge);
    const uint32_t a = ends[0], b = ends[1];
    Middle middle;
    glm::dvec3 smooth(0.0), normal(0.0);
    const auto addSide = [&](uint32_t h) {
        const uint32_t parent = triangles_.triangles[h / 3].parent;
        const auto& corners = mesh_.triangles[parent];
        middle.origin = middleOrigin(origins_[a], origins_[b], corners);
        glm::dvec3 n(0.0);
        smooth = glm::dvec3(0.0);
        for (int k = 0; k < 3; ++k) {
            const auto corner = static_cast<size_t>(k);
            smooth += middle.origin.weights[k] * glm::dvec3(smoothed_[corners[corner]]);
            n += middle.origin.weights[k] * glm::dvec3(normals_[parent][corner]);
        }
        normal += glm::dvec3(unitOrZero(n));
    };
    addSide(halfEdge);
    const uint32_t o = triangles_.opposite[halfEdge];
    if (o != BisectedTriangles::kNone) addSide(o);
    middle.foot = 0.5F * (feet_[a] + feet_[b]);
    middle.tangent = {glm::vec3(smooth), unitOrZero(normal)};
    if (glm::dot(middle.tangent.normal, middle.tangent.normal) > 0) {
        middle.ball = ballBetween(a, b, middle.tangent);
    }
    return middle;
}

/// Below the middle of an edge: as the balls at its ends tell, if there are enough of them and the
/// result is in proportion; else everything is searched.
BallTree::Ball MedialMesh::ballBetween(uint32_t a, uint32_t b,
                                       const BallTree::Tangent& tangent) const {
    constexpr float kProportion = 1.5F;
    const auto most = static_cast<float>(frame_.diagonal / 2);
    if (mesh_.positions.size() < kManyVertices)
        return tree_.largest(tangent, most, balls_[a].contact);
    const std::array<uint32_t, 2> contacts{balls_[a].contact, balls_[b].contact};
    const BallTree::Ball learnt = tree_.beside(tangent, {most, BallTree::kNone}, contacts);
    const float least = std::min(balls_[a].radius, balls_[b].radius);
    if (learnt.contact != BallTree::kNone && learnt.radius <= kProportion * least) return learnt;
    return tree_.largest(tangent, most, learnt.contact);
}

/// What refineEdges asks.
struct MedialMesh::Refinement {
    using Middle = MedialMesh::Middle;
    MedialMesh& mesh;

    std::array<uint32_t, 2> endsOf(uint32_t h) const { return mesh.endsOf(h); }
    double length2(uint32_t h) const { return mesh.length2(h); }
    double shortest2() const {
        const double shortest = mesh.options_.refinement * mesh.frame_.diagonal;
        return shortest * shortest;
    }
    Middle middleOf(uint32_t h) const { return mesh.middleOf(h); }
    bool isEven(uint32_t h, const Middle& middle) const {
        constexpr double kTolerance = 0.003;  // of the diagonal
        constexpr double kOfRadius = 0.1;     // thin walls need more than large bodies
        constexpr double kLong = 0.2;  // of the diagonal: one look in the middle is not enough
        const auto [a, b] = endsOf(h);
        const glm::vec3 found = middle.tangent.point - middle.ball.radius * middle.tangent.normal;
        const double off = glm::distance(found, 0.5F * (mesh.centre(a) + mesh.centre(b)));
        const double radius = std::max({mesh.radius(a), mesh.radius(b), middle.ball.radius});
        const double tolerance = std::min(kTolerance * mesh.frame_.diagonal, kOfRadius * radius);
        const double longest = kLong * mesh.frame_.diagonal;
        return off <= tolerance && length2(h) <= longest * longest;
    }
    uint32_t add(Middle&& middle) {
        mesh.origins_.push_back(middle.origin);
        mesh.feet_.push_back(middle.foot);
        mesh.tangents_.push_back(middle.tangent);
        mesh.balls_.push_back(middle.ball);
        return static_cast<uint32_t>(mesh.feet_.size() - 1);
    }
};

void MedialMesh::refine() {
    const double shortest = options_.refinement * frame_.diagonal;
    std::vector<uint8_t> hasLong(triangles_.triangles.size(), 0);
    parallelRuns(hasLong.size(), kFootGrain, options_.threads, [&](size_t first, size_t last) {
        for (size_t h = 3 * first; h < 3 * last; ++h)
            if (length2(static_cast<uint32_t>(h)) > shortest * shortest) hasLong[h / 3] = 1;
    });
    if (std::find(hasLong.begin(), hasLong.end(), 1) == hasLong.end()) return;
    normals_ = cornerNormals(facets_, mesh_.triangles, corners_, vertexNormals_, hasLong,
                             radians(options_.separationAngle), options_.threads);
    Refinement refinement{*this};
    refineEdges(triangles_, refinement, options_.threads);
}

}  // namespace sherd
