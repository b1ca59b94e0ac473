// SPDX-License-Identifier: MIT
// Distance by E. G. Gilbert, D. W. Johnson and S. S. Keerthi (1988), depth by the expanding
// polytope algorithm (G. van den Bergen, Proximity Queries and Penetration Depth Computation on 3D
// Game Objects, 2001), on the difference of the two hulls: its distance from the origin is theirs.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "sherd/formats/hull_measures.h"

namespace sherd {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Steps end when the bounds are this close, as a share of the size.
constexpr double kClose = 1e-10;
constexpr int kMostSteps = 200;
constexpr double kCoplanar = 1e-12;

using Points = std::span<const glm::dvec3>;

glm::dvec3 farthest(Points points, const glm::dvec3& direction) {
    glm::dvec3 best = points[0];
    double most = -kInfinity;
    for (const glm::dvec3& p : points) {
        const double d = glm::dot(p, direction);
        if (d <= most) continue;
        most = d;
        best = p;
    }
    return best;
}

/// All that comes of taking a point of b from one of a.
class Difference {
  public:
    Difference(Points a, Points b) : a_(a), b_(b) {
        for (const Points side : {a, b})
            for (const glm::dvec3& p : side) size_ = std::max(size_, glm::distance(p, side[0]));
        size_ = std::max(size_, glm::distance(a[0], b[0]));
    }
    glm::dvec3 corner(const glm::dvec3& direction) const {
        return farthest(a_, direction) - farthest(b_, -direction);
    }
    double size() const { return size_; }

  private:
    Points a_, b_;
    double size_ = 0;
};

/// Up to four corners, without an allocation: this is asked for every point sampled.
struct Simplex {
    std::array<glm::dvec3, 4> corners{};
    size_t count = 0;
    void add(const glm::dvec3& p) { corners[count++] = p; }
    const glm::dvec3& operator[](size_t i) const { return corners[i]; }
};

/// Least-norm point of the affine hull of up to three points; nothing if it lies outside of them.
std::optional<glm::dvec3> leastOf(const Simplex& s) {
    if (s.count == 1) return s[0];
    const glm::dvec3 u = s[1] - s[0];
    if (s.count == 2) {
        const double t = -glm::dot(s[0], u) / glm::dot(u, u);
        if (!(t > 0 && t < 1)) return std::nullopt;
        return s[0] + t * u;
    }
    const glm::dvec3 v = s[2] - s[0];
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double su = -glm::dot(s[0], u), sv = -glm::dot(s[0], v);
    const double det = uu * vv - uv * uv;
    const double x = (su * vv - sv * uv) / det, y = (sv * uu - su * uv) / det;
    if (!(x > 0 && y > 0 && x + y < 1)) return std::nullopt;
    const glm::dvec3 n = glm::cross(u, v);
    return n * (glm::dot(n, s[0]) / glm::dot(n, n));
}

/// Keeps of the simplex what its point nearest to the origin lies on.
glm::dvec3 nearestOf(Simplex& simplex) {
    glm::dvec3 nearest(kInfinity);
    double least = kInfinity;
    Simplex kept;
    for (uint32_t chosen = 1; chosen < (1U << simplex.count); ++chosen) {
        Simplex some;
        for (size_t i = 0; i < simplex.count; ++i)
            if ((chosen >> i & 1U) != 0) some.add(simplex[i]);
        if (some.count > 3) continue;
        const std::optional<glm::dvec3> p = leastOf(some);
        if (!p || !(glm::dot(*p, *p) < least)) continue;
        least = glm::dot(*p, *p);
        nearest = *p;
        kept = some;
    }
    simplex = kept;
    return nearest;
}

bool surroundsOrigin(const Simplex& s) {
    for (size_t skip = 0; skip < 4; ++skip) {
        std::array<glm::dvec3, 3> f{};
        for (size_t i = 0, n = 0; i < 4; ++i)
            if (i != skip) f[n++] = s[i];
        const glm::dvec3 n = glm::cross(f[1] - f[0], f[2] - f[0]);
        const double own = glm::dot(n, s[skip] - f[0]), origin = glm::dot(n, -f[0]);
        if (own == 0 || (own > 0) != (origin > 0)) return false;
    }
    return true;
}

/// A growing polytope in the difference, around the origin.
class Expansion {
  public:
    Expansion(const Difference& difference, const Simplex& simplex)
        : difference_(difference), corners_(simplex.corners.begin(), simplex.corners.end()) {
        const glm::dvec3 middle = 0.25 * (corners_[0] + corners_[1] + corners_[2] + corners_[3]);
        for (uint32_t skip = 0; skip < 4; ++skip) {
            std::array<uint32_t, 3> v{};
            for (uint32_t i = 0, n = 0; i < 4; ++i)
                if (i != skip) v[n++] = i;
            const Face face = faceOf(v);
            const bool inwards = glm::dot(face.normal, middle) > face.offset;
            faces_.push_back(inwards ? faceOf({v[0], v[2], v[1]}) : face);
        }
    }

    /// How far the origin lies below the difference's surface.
    double depth() {
        double least = kInfinity;
        for (int step = 0; step < kMostSteps; ++step) {
            const Face nearest =
                *std::min_element(faces_.begin(), faces_.end(),
                                  [](const Face& x, const Face& y) { return x.offset < y.offset; });
            const glm::dvec3 next = difference_.corner(nearest.normal);
            const double beyond = glm::dot(next, nearest.normal);
            // No depth is more than what parts the hulls along some direction.
            least = std::min(least, beyond);
            if (beyond - nearest.offset < kClose * difference_.size() || !grow(next)) break;
        }
        return std::max(least, 0.0);
    }

  private:
    struct Face {
        std::array<uint32_t, 3> v;
        glm::dvec3 normal;
        double offset;
    };
    Face faceOf(const std::array<uint32_t, 3>& v) const {
        const glm::dvec3 n =
            glm::cross(corners_[v[1]] - corners_[v[0]], corners_[v[2]] - corners_[v[0]]);
        const double length = glm::length(n);
        // A face without area says nothing of distances.
        if (!(length > 0)) return {v, glm::dvec3(0, 0, 1), kInfinity};
        return {v, n / length, glm::dot(n, corners_[v[0]]) / length};
    }
    bool grow(const glm::dvec3& corner) {
        std::vector<std::pair<uint32_t, uint32_t>> rim;
        std::vector<Face> kept;
        size_t seen = 0;
        for (const Face& face : faces_) {
            // Faces coplanar to it but for rounding are not seen, or what it sees were no disc.
            if (!(glm::dot(face.normal, corner) > face.offset + kCoplanar * difference_.size())) {
                kept.push_back(face);
                continue;
            }
            ++seen;
            for (size_t k = 0; k < 3; ++k) {
                const std::pair edge(face.v[k], face.v[(k + 1) % 3]);
                const auto twin =
                    std::find(rim.begin(), rim.end(), std::pair(edge.second, edge.first));
                if (twin != rim.end()) {
                    rim.erase(twin);
                } else {
                    rim.push_back(edge);
                }
            }
        }
        if (rim.empty() || rim.size() > seen + 2) return false;
        faces_ = std::move(kept);
        corners_.push_back(corner);
        const auto apex = static_cast<uint32_t>(corners_.size()) - 1;
        for (const auto& [from, to] : rim) faces_.push_back(faceOf({from, to, apex}));
        return true;
    }

    const Difference& difference_;
    std::vector<glm::dvec3> corners_;
    std::vector<Face> faces_;
};

/// A direction that leaves the simplex's plane, line or point.
glm::dvec3 awayFrom(const Simplex& s) {
    if (s.count == 3) return glm::cross(s[1] - s[0], s[2] - s[0]);
    if (s.count == 1) return {1, 0, 0};
    const glm::dvec3 line = s[1] - s[0], steep = glm::abs(line);
    glm::dvec3 axis(0.0);
    axis[steep.x <= steep.y && steep.x <= steep.z ? 0 : (steep.y <= steep.z ? 1 : 2)] = 1;
    return glm::cross(line, axis);
}

/// Adds corners until the simplex, in which the origin lies, is a tetrahedron. Whether it is: a
/// difference may be flat.
bool makeSolid(const Difference& difference, Simplex& simplex) {
    while (simplex.count < 4) {
        const glm::dvec3 away = awayFrom(simplex);
        // All that is perpendicular to a line or point; of a plane there is one normal.
        std::array<glm::dvec3, 3> normals = {away, away, away};
        if (simplex.count == 2) normals[1] = glm::cross(away, simplex[1] - simplex[0]);
        if (simplex.count == 1) normals = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        glm::dvec3 best(0.0);
        double most = 0;
        for (const glm::dvec3& normal : normals) {
            const double length = glm::length(normal);
            for (const double sign : {1 / length, -1 / length}) {
                const glm::dvec3 corner = difference.corner(sign * normal);
                const double height = glm::dot(corner - simplex[0], sign * normal);
                if (!(height > most)) continue;
                most = height;
                best = corner;
            }
        }
        if (!(most > kClose * difference.size())) return false;
        simplex.add(best);
    }
    return true;
}

}  // namespace

namespace {

/// The distance of hulls apart; nothing if they meet: then the simplex holds the origin.
std::optional<double> gapOf(const Difference& difference, Simplex& simplex) {
    glm::dvec3 nearest = simplex[0];
    for (int step = 0; step < kMostSteps; ++step) {
        const double length = glm::length(nearest);
        if (!(length > kClose * difference.size())) return std::nullopt;
        const glm::dvec3 next = difference.corner(-nearest);
        if (length - glm::dot(nearest, next) / length < kClose * difference.size()) return length;
        simplex.add(next);
        if (simplex.count == 4 && surroundsOrigin(simplex)) return std::nullopt;
        nearest = nearestOf(simplex);
        if (!(glm::length(nearest) < length)) return length;
    }
    return glm::length(nearest);
}

}  // namespace

double hullGap(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    const Difference difference(a, b);
    Simplex simplex;
    simplex.add(a[0] - b[0]);
    return gapOf(difference, simplex).value_or(0);
}

double hullDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    const Difference difference(a, b);
    Simplex simplex;
    simplex.add(a[0] - b[0]);
    if (const std::optional<double> gap = gapOf(difference, simplex)) return *gap;
    // Where the origin lies on the simplex it has to be made a solid first.
    if (!makeSolid(difference, simplex)) return 0;
    return -Expansion(difference, simplex).depth();
}

}  // namespace sherd
