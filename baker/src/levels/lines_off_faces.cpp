// SPDX-License-Identifier: MIT
#include "levels/lines_off_faces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "geometry/box_tree.h"

namespace sherd {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// A straight stretch of a line.
struct Stretch {
    glm::dvec2 a{0.0}, b{0.0}, along{0.0};  ///< along: unit
    double length = 0;
    double left = 0, right = 0;  ///< area of faces that want it moved there

    double offset(const glm::dvec2& p) const { return cross(along, p - a); }
    double shift() const { return left == 0 && right == 0 ? 0 : left >= right ? 1 : -1; }
    glm::dvec2 normal() const { return {-along.y, along.x}; }
    bool holds(const glm::dvec2& p, double near) const {
        const double at = glm::dot(p - a, along);
        return std::abs(offset(p)) <= near && at >= -near && at <= length + near;
    }
};

FloatBox boxAround(const glm::dvec2& a, const glm::dvec2& b, double margin) {
    // Floats are a hundred times as coarse as they have to be: the margin is for that, too.
    const double wide = margin + 1e-6;
    const glm::dvec2 low = glm::min(a, b) - wide, high = glm::max(a, b) + wide;
    return {glm::vec3(low, 0), glm::vec3(high, 0)};
}

class LineMover {
  public:
    LineMover(std::span<const UprightFace> faces, double by, FractureMap& map)
        : faces_(faces), by_(by), map_(map) {}

    MovedLines run() {
        std::vector<FloatBox> boxes;
        for (const FractureMap::Line& line : map_.lines) {
            for (size_t k = 0; k + 1 < line.points.size(); ++k) {
                Stretch s{line.points[k], line.points[k + 1]};
                s.length = glm::length(s.b - s.a);
                if (!(s.length > by_)) continue;
                s.along = (s.b - s.a) / s.length;
                boxes.push_back(boxAround(s.a, s.b, by_));
                stretches_.push_back(s);
            }
        }
        if (stretches_.empty()) return {};
        const BoxTree tree(std::move(boxes));
        for (const UprightFace& face : faces_) weigh(face, tree);
        MovedLines result;
        for (const Stretch& s : stretches_) {
            result.moved += s.shift() != 0 ? 1 : 0;
            result.opposed += s.left > 0 && s.right > 0 ? 1 : 0;
        }
        if (result.moved == 0) return result;
        for (FractureMap::Line& line : map_.lines)
            for (glm::dvec2& p : line.points) p += shiftOf(p, tree);
        return result;
    }

  private:
    template <class Visit>
    static void near(const BoxTree& tree, const FloatBox& box, const Visit& visit) {
        tree.any([&](const FloatBox& b) { return b.meets(box); },
                 [&](uint32_t item) {
                     visit(item);
                     return false;
                 });
    }

    void weigh(const UprightFace& face, const BoxTree& tree) {
        near(tree, boxAround(face.from, face.to, by_), [&](uint32_t item) {
            Stretch& s = stretches_[item];
            if (std::abs(s.offset(face.from)) > by_ / 2 || std::abs(s.offset(face.to)) > by_ / 2)
                return;
            const double from = glm::dot(face.from - s.a, s.along);
            const double to = glm::dot(face.to - s.a, s.along);
            const double shared =
                std::min(std::max(from, to), s.length) - std::max(std::min(from, to), 0.0);
            if (!(shared > by_)) return;
            // Away from the solid, which is to the left of the face.
            (to > from ? s.right : s.left) += face.area * shared / std::abs(to - from);
        });
    }

    /// So that the place stays on all moved stretches that it is on: two of them decide it.
    glm::dvec2 shiftOf(const glm::dvec2& p, const BoxTree& tree) const {
        std::vector<uint32_t> on;
        near(tree, boxAround(p, p, by_), [&](uint32_t item) {
            if (stretches_[item].shift() != 0 && stretches_[item].holds(p, by_ / 2))
                on.push_back(item);
        });
        std::sort(on.begin(), on.end());
        std::optional<glm::dvec2> first;
        double wantedFirst = 0;
        for (const uint32_t item : on) {
            const glm::dvec2 normal = stretches_[item].normal();
            const double wanted = by_ * stretches_[item].shift();
            if (!first) {
                first = normal;
                wantedFirst = wanted;
                continue;
            }
            const double sine = cross(*first, normal);
            if (std::abs(sine) < 0.1) continue;
            return glm::dvec2(wantedFirst * normal.y - wanted * first->y,
                              wanted * first->x - wantedFirst * normal.x) /
                   sine;
        }
        return first ? wantedFirst * *first : glm::dvec2(0.0);
    }

    std::span<const UprightFace> faces_;
    double by_;
    FractureMap& map_;
    std::vector<Stretch> stretches_;
};

}  // namespace

MovedLines moveOffFaces(std::span<const UprightFace> faces, double by, FractureMap& map) {
    return LineMover(faces, by, map).run();
}

}  // namespace sherd
