// SPDX-License-Identifier: MIT
#include "repair/cap_holes.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <unordered_set>

#include "geometry/box_tree.h"
#include "geometry/triangle.h"
#include "geometry/triangle_crossing.h"
#include "repair/boundary_loops.h"
#include "repair/least_area_filling.h"
#include "repair/planar_filling.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;
using Triangles = std::vector<Triangle>;

/// Whether triangles would cross any of those that are there.
class Obstacles {
  public:
    Obstacles(const std::vector<glm::vec3>& positions, Triangles triangles)
        : positions_(positions),
          triangles_(std::move(triangles)),
          tree_(boxesOf(positions, triangles_)) {}

    bool meet(const Triangles& others) const {
        const std::vector<FloatBox> boxes = boxesOf(positions_, others);
        for (size_t i = 0; i < others.size(); ++i) {
            const CrossingTest test(places(others[i]));
            const bool crosses =
                tree_.any([&](const FloatBox& box) { return box.meets(boxes[i]); },
                          [&](uint32_t t) { return test.crosses(places(triangles_[t])); });
            if (crosses) return true;
        }
        return false;
    }

  private:
    CrossingTest::Triangle places(const Triangle& t) const {
        return {glm::dvec3(positions_[t[0]]), glm::dvec3(positions_[t[1]]),
                glm::dvec3(positions_[t[2]])};
    }
    const std::vector<glm::vec3>& positions_;
    Triangles triangles_;
    BoxTree tree_;
};

class Capper {
  public:
    Capper(const MeshTopology& topology, SurfaceMesh& mesh)
        : mesh_(mesh), surface_(mesh.positions, mesh.triangles) {
        for (const MeshTopology::Edge& edge : topology.edges)
            edges_.insert(keyOf(edge.low, edge.high));
    }

    HoleCap cap(const BoundaryLoop& loop) {
        HoleCap cap = describe(loop);
        // What closes the hole turns the other way than the surface around it.
        std::vector<uint32_t> corners(loop.rbegin(), loop.rend());
        std::vector<glm::vec3> polygon;
        polygon.reserve(corners.size());
        for (const uint32_t h : corners) polygon.push_back(mesh_.positions[vertexOf(h)]);
        const auto forbidden = [&](uint32_t a, uint32_t b) {
            return edges_.count(keyOf(vertexOf(corners[a]), vertexOf(corners[b]))) > 0;
        };
        if (accept(fillInPlane(polygon), corners, forbidden)) {
            cap.flat = true;
        } else if (!accept(fillWithLeastArea(polygon, forbidden), corners, forbidden)) {
            cap.refusal = polygon.size() < 3 ? "it has two sides only"
                          : polygon.size() > kMostCornersOfLeastArea
                              ? "it is not flat and has more than " +
                                    std::to_string(kMostCornersOfLeastArea) + " corners"
                              : "what would close it crosses the surface or another cap";
            return cap;
        }
        for (size_t t = mesh_.triangles.size() - added_; t < mesh_.triangles.size(); ++t)
            cap.area += triangleArea(mesh_.positions, mesh_.triangles[t]);
        return cap;
    }

  private:
    uint32_t vertexOf(uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }
    static uint64_t keyOf(uint32_t a, uint32_t b) {
        return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }

    HoleCap describe(const BoundaryLoop& loop) const {
        HoleCap cap;
        cap.corners = static_cast<uint32_t>(loop.size());
        for (size_t i = 0; i < loop.size(); ++i) {
            const glm::dvec3 p(mesh_.positions[vertexOf(loop[i])]);
            cap.place += p / static_cast<double>(loop.size());
            cap.length += glm::distance(
                p, glm::dvec3(mesh_.positions[vertexOf(loop[(i + 1) % loop.size()])]));
        }
        return cap;
    }

    /// Adds the filling to the mesh unless it does not fit; `corners` are the half edges that begin
    /// at the polygon's.
    bool accept(const Triangles& filling, const std::vector<uint32_t>& corners,
                const std::function<bool(uint32_t, uint32_t)>& forbidden) {
        if (filling.empty()) return false;
        Triangles triangles;
        for (const Triangle& t : filling) {
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = t[k], b = t[(k + 1) % 3];
                const bool border = (a + 1) % corners.size() == b || (b + 1) % corners.size() == a;
                if (!border && forbidden(a, b)) return false;
            }
            triangles.push_back(
                {vertexOf(corners[t[0]]), vertexOf(corners[t[1]]), vertexOf(corners[t[2]])});
        }
        if (surface_.meet(triangles) || Obstacles(mesh_.positions, caps_).meet(triangles))
            return false;
        add(filling, triangles, corners);
        return true;
    }

    void add(const Triangles& filling, const Triangles& triangles,
             const std::vector<uint32_t>& corners) {
        const uint32_t material = materialAround(corners);
        const uint32_t first = addAttributes(corners);
        for (const Triangle& t : filling)
            mesh_.corners.push_back({first + t[0], first + t[1], first + t[2]});
        for (const Triangle& t : triangles)
            for (size_t k = 0; k < 3; ++k) edges_.insert(keyOf(t[k], t[(k + 1) % 3]));
        mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
        mesh_.triangleMaterials.resize(mesh_.triangles.size(), material);
        caps_.insert(caps_.end(), triangles.begin(), triangles.end());
        added_ = triangles.size();
        mesh_.capTriangles += static_cast<uint32_t>(added_);
    }

    /// That of the most half edges; of as many, the first.
    uint32_t materialAround(const std::vector<uint32_t>& corners) const {
        std::map<uint32_t, size_t> count;
        for (const uint32_t h : corners) ++count[mesh_.triangleMaterials[h / 3]];
        return std::max_element(count.begin(), count.end(),
                                [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first;
    }

    /// A vertex for each corner, like the surface's there; the first one's index.
    uint32_t addAttributes(const std::vector<uint32_t>& corners) {
        const bool whole = inOneChart(corners);
        uint32_t first = 0;
        for (Attribute& attribute : mesh_.attributes) {
            const uint32_t n = attribute.components;
            first = static_cast<uint32_t>(attribute.values.size() / n);
            const bool pointLike = !whole && attribute.semantic == mesh_.uvSemantic;
            for (const uint32_t h : corners) {
                const uint32_t from = attributeOf(pointLike ? corners[0] : h);
                for (uint32_t c = 0; c < n; ++c) {
                    const float value = attribute.values[size_t{from} * n + c];
                    attribute.values.push_back(value);
                }
            }
        }
        return first;
    }
    uint32_t attributeOf(uint32_t h) const { return mesh_.corners[h / 3][h % 3]; }

    /// At every corner the two edges that meet there have one place in the drawing.
    bool inOneChart(const std::vector<uint32_t>& corners) const {
        const Attribute* uv = findAttribute(mesh_.attributes, mesh_.uvSemantic);
        if (uv == nullptr) return true;
        const auto at = [&](uint32_t vertex) {
            return std::array{uv->values[2 * size_t{vertex}], uv->values[2 * size_t{vertex} + 1]};
        };
        for (size_t i = 0; i < corners.size(); ++i) {
            // The half edge before, on the surface, ends where corner i begins.
            const uint32_t before = corners[(i + 1) % corners.size()];
            if (at(attributeOf(nextCorner(before))) != at(attributeOf(corners[i]))) return false;
        }
        return true;
    }

    SurfaceMesh& mesh_;
    Obstacles surface_;
    Triangles caps_;
    size_t added_ = 0;  ///< triangles of the last cap
    std::unordered_set<uint64_t> edges_;
};

}  // namespace

std::vector<HoleCap> capHoles(const MeshTopology& topology, SurfaceMesh& mesh,
                              const CapOptions& options) {
    const std::vector<BoundaryLoop> loops = boundaryLoops(topology, mesh.triangles);
    size_t corners = 0;
    for (const BoundaryLoop& loop : loops) corners += loop.size();
    std::vector<HoleCap> caps;
    if (loops.size() > options.mostHoles || corners > options.mostCorners) {
        HoleCap none;
        none.refusal = "there are " + std::to_string(loops.size()) + " holes with " +
                       std::to_string(corners) + " corners; up to " +
                       std::to_string(options.mostHoles) + " with " +
                       std::to_string(options.mostCorners) + " are capped";
        caps.push_back(none);
        return caps;
    }
    Capper capper(topology, mesh);
    for (const BoundaryLoop& loop : loops) caps.push_back(capper.cap(loop));
    return caps;
}

}  // namespace sherd
