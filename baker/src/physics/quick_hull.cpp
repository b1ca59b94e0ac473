// SPDX-License-Identifier: MIT
// Quickhull (C. B. Barber, D. P. Dobkin and H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls,
// 1996) with exact orientation tests (J. R. Shewchuk, 1997) in place of its facet merging: what a
// point sees is then a disc whatever rounding did to the points. Points that lie in a face but for
// rounding, as those do that a plane cuts, are left out before: they would become corners. Bullet's
// btConvexHullComputer rounds to 1/10216 of the extent, more than neighbouring colliders may
// overlap; Qhull with merged facets gives no triangles that fit together.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/bounds.h"
#include "geometry/no_index.h"
#include "geometry/predicates.h"
#include "physics/polytope.h"

namespace sherd {
namespace {

/// Bodies thinner than one in so much of their diagonal get a thinner skin.
constexpr double kBulk = 4;

class QuickHull {
  public:
    QuickHull(std::span<const glm::dvec3> points, double skin)
        : points_(points), nextOutside_(points.size(), kNone), faceFrom_(points.size(), kNone) {
        Bounds box;
        for (const glm::dvec3& p : points) {
            most_ = std::max({most_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            box.add(p);
        }
        diagonal_ = std::max(box.diagonal(), 1e-300);
        skin_ = skin * diagonal_;
    }

    bool run() {
        if (!start()) return false;
        while (!waiting_.empty()) {
            const uint32_t face = waiting_.back();
            waiting_.pop_back();
            if (!faces_[face].gone && faces_[face].outside != kNone) grow(face);
        }
        return true;
    }

    Polytope result() {
        Polytope out;
        std::vector<uint32_t> corners;
        for (const Face& face : faces_)
            if (!face.gone) corners.insert(corners.end(), face.v.begin(), face.v.end());
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        for (uint32_t i = 0; i < corners.size(); ++i) {
            faceFrom_[corners[i]] = i;
            out.points.push_back(points_[corners[i]]);
        }
        for (const Face& face : faces_)
            if (!face.gone)
                out.faces.push_back(
                    {faceFrom_[face.v[0]], faceFrom_[face.v[1]], faceFrom_[face.v[2]]});
        out.sources = std::move(corners);
        return out;
    }

  private:
    struct Face {
        std::array<uint32_t, 3> v;
        std::array<uint32_t, 3> across{kNone, kNone, kNone};  ///< behind the edge from corner k
        glm::dvec3 normal{0.0};                               ///< twice the area long
        double offset = 0, error = 0, skin = 0;               ///< in lengths of the normal
        uint32_t outside = kNone;   ///< first of the points that only this face is asked about
        uint32_t farthest = kNone;  ///< of them
        double distance = 0;
        bool gone = false;
    };
    struct RimEdge {
        uint32_t from, to, behind;
    };

    uint32_t addFace(uint32_t a, uint32_t b, uint32_t c) {
        const glm::dvec3 ab = points_[b] - points_[a], ac = points_[c] - points_[a];
        Face face;
        face.v = {a, b, c};
        face.normal = glm::cross(ab, ac);
        face.offset = glm::dot(face.normal, points_[a]);
        face.error = 1e-14 * most_ * std::sqrt(glm::dot(ab, ab) * glm::dot(ac, ac));
        face.skin = skin_ * glm::length(face.normal);
        faces_.push_back(face);
        return static_cast<uint32_t>(faces_.size()) - 1;
    }

    double height(const Face& face, uint32_t p) const {
        return glm::dot(face.normal, points_[p]) - face.offset;
    }

    bool sees(const Face& face, uint32_t p) const {
        const double h = height(face, p);
        if (h > face.error) return true;
        if (h < -face.error) return false;
        return orient3d(points_[face.v[0]], points_[face.v[1]], points_[face.v[2]], points_[p]) > 0;
    }

    bool isAbove(const Face& face, uint32_t p) const {
        const double h = height(face, p);
        if (h > face.skin + face.error) return true;
        if (h < face.skin - face.error) return false;
        return sees(face, p);
    }

    uint32_t farthest(const auto& measure) const {
        uint32_t best = 0;
        double most = -1;
        for (uint32_t i = 0; i < points_.size(); ++i) {
            const double m = measure(points_[i]);
            if (m > most) {
                most = m;
                best = i;
            }
        }
        return best;
    }

    /// A tetrahedron of points far apart.
    bool start() {
        if (points_.size() < 4) return false;
        const glm::dvec3 a = points_[0];
        const auto squared = [](const glm::dvec3& d) { return glm::dot(d, d); };
        const uint32_t i = farthest([&](const glm::dvec3& p) { return squared(p - a); });
        const glm::dvec3 b = points_[i];
        const uint32_t j = farthest([&](const glm::dvec3& p) { return squared(p - b); });
        const glm::dvec3 line = points_[j] - b;
        const uint32_t k =
            farthest([&](const glm::dvec3& p) { return squared(glm::cross(line, p - b)); });
        const glm::dvec3 normal = glm::cross(line, points_[k] - b);
        uint32_t l =
            farthest([&](const glm::dvec3& p) { return std::abs(glm::dot(normal, p - b)); });
        int side = orient3d(points_[i], points_[j], points_[k], points_[l]);
        // Nearly flat: rounding may have picked a point in the plane.
        for (uint32_t p = 0; side == 0 && p < points_.size(); ++p) {
            l = p;
            side = orient3d(points_[i], points_[j], points_[k], points_[p]);
        }
        if (side == 0) return false;
        // All faces of a flat body look the same two ways: heights above them say little of how
        // far off a point is along it.
        const double thickness =
            std::abs(glm::dot(normal, points_[l] - b)) / std::max(glm::length(normal), 1e-300);
        skin_ *= std::min(1.0, kBulk * thickness / diagonal_);
        addTetrahedron(side > 0 ? std::array{i, k, j, l} : std::array{i, j, k, l});
        return true;
    }

    /// l lies behind i, j, k.
    void addTetrahedron(const std::array<uint32_t, 4>& v) {
        const auto [i, j, k, l] = v;
        addFace(i, j, k);
        addFace(i, l, j);
        addFace(j, l, k);
        addFace(k, l, i);
        faces_[0].across = {1, 2, 3};
        faces_[1].across = {3, 2, 0};
        faces_[2].across = {1, 3, 0};
        faces_[3].across = {2, 1, 0};
        for (uint32_t p = 0; p < points_.size(); ++p) assign(p, 0);
    }

    /// To the first face from `first` on that the point is above, or one behind the rim: of points
    /// in the skin of new faces some are farther above those. None: it is inside.
    void assign(uint32_t p, uint32_t first) {
        for (uint32_t f = first; f < faces_.size(); ++f)
            if (assignTo(f, p)) return;
        for (const RimEdge& edge : rim_)
            if (assignTo(edge.behind, p)) return;
    }

    bool assignTo(uint32_t f, uint32_t p) {
        Face& face = faces_[f];
        if (!isAbove(face, p)) return false;
        const double h = height(face, p);
        if (face.outside == kNone) waiting_.push_back(f);
        if (face.outside == kNone || h > face.distance) {
            face.distance = h;
            face.farthest = p;
        }
        nextOutside_[p] = face.outside;
        face.outside = p;
        return true;
    }

    /// Replaces all that the face's farthest point sees by a cone from the rim to it.
    void grow(uint32_t face) {
        const uint32_t apex = faces_[face].farthest;
        findVisible(face, apex);
        const auto first = static_cast<uint32_t>(faces_.size());
        for (const RimEdge& edge : rim_) {
            const uint32_t made = addFace(edge.from, edge.to, apex);
            faces_[made].across[0] = edge.behind;
            faceFrom_[edge.from] = made;
            Face& behind = faces_[edge.behind];
            for (uint32_t k = 0; k < 3; ++k)
                if (behind.v[k] == edge.to && behind.v[(k + 1) % 3] == edge.from)
                    behind.across[k] = made;
        }
        for (uint32_t f = first; f < faces_.size(); ++f) {
            const uint32_t next = faceFrom_[faces_[f].v[1]];
            faces_[f].across[1] = next;
            faces_[next].across[2] = f;
        }
        for (const uint32_t f : visible_) {
            for (uint32_t p = faces_[f].outside; p != kNone;) {
                const uint32_t next = nextOutside_[p];
                if (p != apex) assign(p, first);
                p = next;
            }
        }
    }

    void findVisible(uint32_t from, uint32_t apex) {
        visible_.assign(1, from);
        rim_.clear();
        faces_[from].gone = true;
        for (size_t i = 0; i < visible_.size(); ++i) {
            const Face& face = faces_[visible_[i]];
            for (uint32_t k = 0; k < 3; ++k) {
                Face& behind = faces_[face.across[k]];
                if (behind.gone) continue;
                if (sees(behind, apex)) {
                    behind.gone = true;
                    visible_.push_back(face.across[k]);
                }
            }
        }
        for (const uint32_t f : visible_) {
            const Face& face = faces_[f];
            for (uint32_t k = 0; k < 3; ++k)
                if (!faces_[face.across[k]].gone)
                    rim_.push_back({face.v[k], face.v[(k + 1) % 3], face.across[k]});
        }
    }

    std::span<const glm::dvec3> points_;
    double most_ = 0, diagonal_ = 0, skin_ = 0;
    std::vector<Face> faces_;
    std::vector<uint32_t> nextOutside_;  ///< per point
    std::vector<uint32_t> faceFrom_;     ///< per point: the new face whose rim edge starts there
    std::vector<uint32_t> waiting_, visible_;
    std::vector<RimEdge> rim_;
};

}  // namespace

Polytope hullOf(std::span<const glm::dvec3> points, double skin) {
    QuickHull hull(points, skin);
    return hull.run() ? hull.result() : Polytope{};
}

}  // namespace sherd
