// SPDX-License-Identifier: MIT
// Walls are shared exactly: the same three positions, seen from both sides. Facing medial sheets
// share no vertices: each triangle takes the nearest opposed one of another leaf as its partner,
// and what two leaves see of each other is averaged.
#include "physics/bonds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "geometry/triangle_bvh.h"
#include "geometry/weld.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// Sheets face each other when their normals are at least 120 degrees apart.
constexpr double kOpposed = -0.5;

struct Facet {
    glm::dvec3 normal{0.0};  ///< unit, out of the leaf; zero if degenerate
    glm::dvec3 centroid{0.0};
    double area = 0;
};

std::vector<Facet> measure(std::span<const glm::vec3> positions,
                           std::span<const HiddenTriangle> triangles) {
    std::vector<Facet> out;
    out.reserve(triangles.size());
    for (const HiddenTriangle& t : triangles) {
        const glm::dvec3 a(positions[t.vertices[0]]);
        const glm::dvec3 b(positions[t.vertices[1]]);
        const glm::dvec3 c(positions[t.vertices[2]]);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double length = glm::length(n);
        out.push_back({length > 0 ? n / length : n, (a + b + c) / 3.0, 0.5 * length});
    }
    return out;
}

/// One side's view of what two leaves share.
struct Sum {
    double area = 0;
    glm::dvec3 centroid{0.0};  ///< times area
    glm::dvec3 normal{0.0};    ///< times area
};

class BondFinder {
  public:
    BondFinder(std::span<const glm::vec3> positions, std::span<const HiddenTriangle> triangles)
        : positions_(positions),
          triangles_(triangles),
          facets_(measure(positions, triangles)),
          matched_(triangles.size(), false) {}

    /// Pairs triangles of the same three positions and opposite orientation.
    void matchWalls() {
        std::vector<Key> keys = wallKeys();
        std::sort(keys.begin(), keys.end());
        for (size_t first = 0; first < keys.size();) {
            size_t last = first + 1;
            while (last < keys.size() && keys[last].ids == keys[first].ids) ++last;
            for (size_t i = first; i < last; ++i) {
                for (size_t j = i + 1; j < last && !matched_[keys[i].triangle]; ++j) {
                    if (isPair(keys[i], keys[j])) addWall(keys[i].triangle, keys[j].triangle);
                }
            }
            first = last;
        }
    }

    void matchSheets(const BondOptions& options) {
        std::vector<uint32_t> free;
        std::vector<Triangle> corners;
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            if (matched_[t] || !(facets_[t].area > 0)) continue;
            free.push_back(t);
            corners.push_back(triangles_[t].vertices);
        }
        if (free.empty() || !(options.sheetTolerance > 0)) return;
        const TriangleBvh bvh(positions_, corners);
        std::vector<ClosestPoint> partners(free.size());
        parallelRuns(free.size(), 4096, options.threads, [&](size_t first, size_t last) {
            findPartners(bvh, options.sheetTolerance, free, first, last, partners);
        });
        for (size_t i = 0; i < free.size(); ++i) {
            if (partners[i].triangle == ClosestPoint::kNone) continue;
            add(free[i], triangles_[free[partners[i].triangle]].leaf, 0.5,
                0.5 * (facets_[free[i]].centroid + partners[i].point));
        }
    }

    std::vector<LeafBond> bonds() const {
        std::vector<LeafBond> out;
        for (const auto& [pair, sum] : sums_) {
            if (!(sum.area > 0)) continue;
            LeafBond& bond = out.emplace_back();
            bond.a = pair.first;
            bond.b = pair.second;
            bond.area = sum.area;
            bond.centroid = sum.centroid / sum.area;
            // A surface that closes on itself (a stone in a wall) has no mean direction.
            const double length = glm::length(sum.normal);
            if (length > 1e-9 * sum.area) bond.normal = sum.normal / length;
        }
        return out;
    }

  private:
    struct Key {
        Triangle ids;  ///< ascending
        bool isEven;   ///< whether the triangle turns the way the ids do
        uint32_t triangle;
        bool operator<(const Key& o) const {
            return std::tie(ids, triangle) < std::tie(o.ids, o.triangle);
        }
    };

    std::vector<Key> wallKeys() const {
        std::vector<glm::vec3> corners;
        corners.reserve(3 * triangles_.size());
        for (const HiddenTriangle& t : triangles_) {
            for (const uint32_t v : t.vertices) corners.push_back(positions_[v]);
        }
        std::vector<glm::vec3> distinct;
        const std::vector<uint32_t> ids = PositionWelder(distinct).add(corners);
        std::vector<Key> keys;
        keys.reserve(triangles_.size());
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            Triangle v{ids[3 * t], ids[3 * t + 1], ids[3 * t + 2]};
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
            std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
            const bool isEven = v[1] < v[2];
            if (!isEven) std::swap(v[1], v[2]);
            keys.push_back({v, isEven, t});
        }
        return keys;
    }

    /// The opposed triangles nearest to those of free[first, last). Neighbours in the list are
    /// mostly neighbours in space: the last partner bounds the search, and does not change what it
    /// finds.
    void findPartners(const TriangleBvh& bvh, double tolerance, const std::vector<uint32_t>& free,
                      size_t first, size_t last, std::vector<ClosestPoint>& partners) const {
        uint32_t hint = 0;
        for (size_t i = first; i < last; ++i) {
            const uint32_t t = free[i];
            const auto faces = [&](uint32_t other) {
                const uint32_t u = free[other];
                return triangles_[u].leaf != triangles_[t].leaf &&
                       glm::dot(facets_[t].normal, facets_[u].normal) < kOpposed;
            };
            const glm::dvec3& from = facets_[t].centroid;
            const double reach = faces(hint) ? distanceTo(from, free[hint]) : tolerance;
            partners[i] = bvh.closest(from, std::min(tolerance, reach * (1 + 1e-9)), faces);
            if (partners[i].triangle != ClosestPoint::kNone) hint = partners[i].triangle;
        }
    }

    double distanceTo(const glm::dvec3& p, uint32_t t) const {
        const Triangle& v = triangles_[t].vertices;
        return glm::distance(
            p, closestOnTriangle(p, glm::dvec3(positions_[v[0]]), glm::dvec3(positions_[v[1]]),
                                 glm::dvec3(positions_[v[2]])));
    }

    bool isPair(const Key& x, const Key& y) const {
        return x.isEven != y.isEven && !matched_[x.triangle] && !matched_[y.triangle] &&
               triangles_[x.triangle].leaf != triangles_[y.triangle].leaf;
    }

    void addWall(uint32_t t, uint32_t u) {
        matched_[t] = matched_[u] = true;
        add(t, triangles_[u].leaf, 1, facets_[t].centroid);
    }

    /// `share` of triangle t holds its leaf to `other`, at `place`.
    void add(uint32_t t, uint32_t other, double share, const glm::dvec3& place) {
        const uint32_t leaf = triangles_[t].leaf;
        Sum& sum = sums_[std::minmax(leaf, other)];
        const double area = share * facets_[t].area;
        sum.area += area;
        sum.centroid += area * place;
        sum.normal += (leaf < other ? area : -area) * facets_[t].normal;
    }

    std::span<const glm::vec3> positions_;
    std::span<const HiddenTriangle> triangles_;
    std::vector<Facet> facets_;
    std::vector<bool> matched_;
    std::map<std::pair<uint32_t, uint32_t>, Sum> sums_;
};

}  // namespace

std::vector<LeafBond> findBonds(std::span<const glm::vec3> positions,
                                std::span<const HiddenTriangle> triangles,
                                const BondOptions& options) {
    BondFinder finder(positions, triangles);
    finder.matchWalls();
    finder.matchSheets(options);
    return finder.bonds();
}

}  // namespace sherd
