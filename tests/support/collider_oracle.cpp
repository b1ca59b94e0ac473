// SPDX-License-Identifier: MIT
#include "support/collider_oracle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

namespace sherd::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double reachOf(std::span<const glm::dvec3> points, const glm::dvec3& direction) {
    double most = -kInfinity;
    for (const glm::dvec3& p : points) most = std::max(most, glm::dot(direction, p));
    return most;
}

/// From p to the segment or triangle that the corners span (C. Ericson, Real-Time Collision
/// Detection, 2005, 5.1).
double distanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double length2 = glm::dot(ab, ab);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * ab);
}

double distanceToTriangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t,
                          const glm::dvec3& normal) {
    bool above = true;
    double least = kInfinity;
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
        above = above && glm::dot(glm::cross(b - a, p - a), normal) >= 0;
        least = std::min(least, distanceToSegment(p, a, b));
    }
    return above ? std::min(least, std::abs(glm::dot(normal, p - t[0]))) : least;
}

}  // namespace

RoundedHull::RoundedHull(std::vector<glm::dvec3> corners, double margin)
    : corners_(std::move(corners)), margin_(margin) {
    const auto count = static_cast<uint32_t>(corners_.size());
    glm::dvec3 low = corners_[0], high = corners_[0];
    for (const glm::dvec3& p : corners_) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    // What floats make of corners in one plane; a wrong face would only add a direction to ask.
    const double flat = 1e-6 * (glm::distance(low, high) + glm::length(high));
    std::set<std::array<uint32_t, 2>> edges;
    for (uint32_t i = 0; i < count; ++i) {
        for (uint32_t j = 0; j < count; ++j) {
            for (uint32_t k = 0; k < count; ++k) {
                if (i == j || j == k || k == i || i > j || i > k) continue;
                const glm::dvec3 cross =
                    glm::cross(corners_[j] - corners_[i], corners_[k] - corners_[i]);
                const double length = glm::length(cross);
                if (!(length > 0)) continue;
                const glm::dvec3 normal = cross / length;
                const double offset = glm::dot(normal, corners_[i]);
                if (std::any_of(corners_.begin(), corners_.end(), [&](const glm::dvec3& p) {
                        return glm::dot(normal, p) > offset + flat;
                    }))
                    continue;
                faces_.push_back({{i, j, k}, normal, offset});
                for (const auto& [a, b] : {std::pair(i, j), std::pair(j, k), std::pair(k, i)})
                    edges.insert({std::min(a, b), std::max(a, b)});
            }
        }
    }
    edges_.assign(edges.begin(), edges.end());
}

double RoundedHull::reach(const glm::dvec3& direction) const {
    return reachOf(corners_, direction);
}

std::vector<glm::dvec3> RoundedHull::normals() const {
    std::vector<glm::dvec3> normals;
    for (const Face& face : faces_) normals.push_back(face.normal);
    return normals;
}

double RoundedHull::distance(const glm::dvec3& p) const {
    double highest = -kInfinity, least = kInfinity;
    for (const Face& face : faces_)
        highest = std::max(highest, glm::dot(face.normal, p) - face.offset);
    if (highest <= 0) return 0;
    for (const Face& face : faces_) {
        const auto& [a, b, c] = face.corners;
        least = std::min(
            least, distanceToTriangle(p, {corners_[a], corners_[b], corners_[c]}, face.normal));
    }
    return std::max(0.0, least - margin_);
}

double apart(const RoundedHull& a, const RoundedHull& b, double enough) {
    const double margins = a.margin_ + b.margin_;
    double widest = -kInfinity;
    // From a to b. Returns whether that is enough.
    const auto ask = [&](const glm::dvec3& direction) {
        const double length = glm::length(direction);
        if (!(length > 1e-12)) return false;
        const glm::dvec3 d = direction / length;
        widest = std::max(widest, -b.reach(-d) - a.reach(d) - margins);
        return widest >= enough;
    };
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 d(0);
        d[axis] = 1;
        if (ask(d) || ask(-d)) return widest;
    }
    for (const auto& face : a.faces_)
        if (ask(face.normal)) return widest;
    for (const auto& face : b.faces_)
        if (ask(-face.normal)) return widest;
    for (const auto& [i, j] : a.edges_) {
        const glm::dvec3 edge = a.corners_[j] - a.corners_[i];
        for (const auto& [k, l] : b.edges_) {
            const glm::dvec3 cross = glm::cross(edge, b.corners_[l] - b.corners_[k]);
            if (ask(cross) || ask(-cross)) return widest;
        }
    }
    const auto askFromEdges = [&](const RoundedHull& own, const RoundedHull& other, double sign) {
        for (const auto& [i, j] : own.edges_) {
            const glm::dvec3 edge = glm::normalize(own.corners_[j] - own.corners_[i]);
            for (const glm::dvec3& p : other.corners_) {
                const glm::dvec3 to = p - own.corners_[i];
                if (ask(sign * (to - glm::dot(to, edge) * edge))) return true;
            }
        }
        return false;
    };
    if (askFromEdges(a, b, 1) || askFromEdges(b, a, -1)) return widest;
    for (const glm::dvec3& p : a.corners_)
        for (const glm::dvec3& q : b.corners_)
            if (ask(q - p)) return widest;
    return widest;
}

std::vector<RoundedHull> colliderOf(const FractureSet& set, uint32_t fragment) {
    std::vector<RoundedHull> hulls;
    const Range range = set.fragments[fragment].hulls;
    for (uint32_t h = range.first; h < range.first + range.count; ++h) {
        const ConvexHull& hull = set.hulls[h];
        const auto first = set.hullPoints.begin() + hull.points.first;
        hulls.emplace_back(std::vector<glm::dvec3>(first, first + hull.points.count),
                           double{hull.margin});
    }
    return hulls;
}

WrittenPiece::WrittenPiece(const FractureSet& set, uint32_t fragment) {
    const size_t primitives = set.geometry.primitives.size();
    for (size_t p = 0; p < primitives; ++p) {
        const Primitive& primitive = set.geometry.primitives[p];
        if (primitive.exposedFrom > set.fragments[fragment].level) continue;
        const Range range = set.fragmentRanges[fragment * primitives + p];
        for (uint32_t i = range.first; i < range.first + range.count; i += 3) {
            const auto at = [&](uint32_t k) {
                return glm::dvec3(set.geometry.positions[set.geometry.indices[i + k]]);
            };
            triangles_.push_back({at(0), at(1), at(2)});
            if (primitive.exposedFrom == 0) skin_.insert(skin_.end(), {at(0), at(1), at(2)});
        }
    }
    const auto before = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    for (const auto& t : triangles_) corners_.insert(corners_.end(), t.begin(), t.end());
    std::sort(corners_.begin(), corners_.end(), before);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    if (corners_.empty()) return;
    low_ = high_ = corners_[0];
    for (const glm::dvec3& p : corners_) {
        low_ = glm::min(low_, p);
        high_ = glm::max(high_, p);
    }
}

double WrittenPiece::size() const {
    const glm::dvec3 size = high_ - low_;
    return std::max({size.x, size.y, size.z});
}

double WrittenPiece::volume() const {
    double six = 0;
    for (const auto& [a, b, c] : triangles_)
        six += glm::dot(a - low_, glm::cross(b - low_, c - low_));
    return six / 6;
}

double WrittenPiece::winding(const glm::dvec3& p) const {
    double sum = 0;
    for (const auto& t : triangles_) {
        const glm::dvec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(
            glm::dot(a, glm::cross(b, c)),
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

double WrittenPiece::bulge() const {
    double most = 0;
    const double sliver = 1e-6 * size() * size();
    for (const auto& [a, b, c] : triangles_) {
        const glm::dvec3 cross = glm::cross(b - a, c - a);
        const double length = glm::length(cross);
        if (!(length > sliver)) continue;
        most = std::max(most, reachOf(corners_, cross / length) - glm::dot(cross, a) / length);
    }
    return most;
}

double WrittenPiece::reach(const glm::dvec3& direction) const {
    return reachOf(corners_, direction);
}

}  // namespace sherd::test
