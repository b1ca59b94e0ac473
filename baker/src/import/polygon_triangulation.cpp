// SPDX-License-Identifier: MIT
// Ear clipping (G. H. Meisters, Polygons Have Ears, 1975) in the plane of the polygon's Newell
// normal. Quadratic in practice, which is fine for the polygons modellers make.
#include "import/polygon_triangulation.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along its normal's largest component, counter-clockwise.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> polygon) {
    glm::dvec3 normal(0.0);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a(polygon[i]);
        const glm::dvec3 b(polygon[(i + 1) % polygon.size()]);
        normal += glm::cross(a - glm::dvec3(polygon[0]), b - glm::dvec3(polygon[0]));
    }
    const glm::dvec3 size = glm::abs(normal);
    int axis = 2;
    if (size.x >= size.y && size.x >= size.z) {
        axis = 0;
    } else if (size.y >= size.z) {
        axis = 1;
    }
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<glm::dvec2> flat;
    flat.reserve(polygon.size());
    for (const glm::vec3& p : polygon) flat.emplace_back(p[u], p[v]);
    return flat;
}

class EarClipper {
  public:
    explicit EarClipper(std::vector<glm::dvec2> points) : points_(std::move(points)) {
        for (uint32_t i = 0; i < points_.size(); ++i) ring_.push_back(i);
    }

    std::vector<Triangle> run() {
        std::vector<Triangle> out;
        out.reserve(points_.size() - 2);
        size_t at = 1;
        while (ring_.size() > 3) {
            at = findEar(at);
            out.push_back(corner(at));
            ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
            at %= ring_.size();
        }
        out.push_back({ring_[0], ring_[1], ring_[2]});
        return out;
    }

  private:
    Triangle corner(size_t i) const {
        const size_t n = ring_.size();
        return {ring_[(i + n - 1) % n], ring_[i], ring_[(i + 1) % n]};
    }

    double area(const Triangle& t) const {
        return turn(points_[t[0]], points_[t[1]], points_[t[2]]);
    }

    bool isEmpty(const Triangle& t) const {
        const glm::dvec2& a = points_[t[0]];
        const glm::dvec2& b = points_[t[1]];
        const glm::dvec2& c = points_[t[2]];
        for (const uint32_t i : ring_) {
            const glm::dvec2& p = points_[i];
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    /// A convex corner with nothing inside; else a straight one; else any.
    size_t findEar(size_t start) const {
        size_t straight = start;
        for (size_t k = 0; k < ring_.size(); ++k) {
            const size_t i = (start + k) % ring_.size();
            const Triangle t = corner(i);
            const double size = area(t);
            if (size > 0 && isEmpty(t)) return i;
            if (size == 0) straight = i;
        }
        return straight;
    }

    std::vector<glm::dvec2> points_;
    std::vector<uint32_t> ring_;
};

}  // namespace

std::vector<Triangle> triangulatePolygon(std::span<const glm::vec3> polygon) {
    if (polygon.size() < 3) return {};
    if (polygon.size() == 3) return {{0, 1, 2}};
    return EarClipper(flatten(polygon)).run();
}

}  // namespace sherd
