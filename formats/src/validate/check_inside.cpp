// SPDX-License-Identifier: MIT
// Nothing hidden sticks out of the object; and how completely a level fills it.
#include <algorithm>
#include <memory>
#include <optional>
#include <random>

#include "check_context.h"
#include "ray_grid.h"
#include "triangle_tree.h"

namespace sherd {

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Inside means enclosed at least once, so overlapping closed parts count as one solid.
class Solid {
  public:
    Solid(const FractureSet& set, bool open)
        : positions_(set.geometry.positions), triangles_(fragmentTriangles(set, 0)), open_(open) {}

    bool contains(const glm::dvec3& point) {
        if (winding(2, point) >= 1) return true;
        // A ray that passes a hole of an open object proves nothing; three rarely all do.
        return open_ && (winding(0, point) >= 1 || winding(1, point) >= 1);
    }

    double distance(const glm::dvec3& point, double enough) {
        if (!tree_) tree_ = std::make_unique<TriangleTree>(positions_, triangles_);
        return tree_->distance(point, enough);
    }

  private:
    int winding(int axis, const glm::dvec3& point) {
        if (!grids_[axis])
            grids_[axis] =
                std::make_unique<RayGrid>(positions_, triangles_, std::vector<uint32_t>(), axis);
        return grids_[axis]->winding(point);
    }

    const std::vector<glm::vec3>& positions_;
    Triangles triangles_;
    bool open_;
    std::array<std::unique_ptr<RayGrid>, 3> grids_;
    std::unique_ptr<TriangleTree> tree_;
};

/// The triangles of all leaves in primitives that are hidden in the intact object.
Triangles hiddenTriangles(const FractureSet& set) {
    Triangles result;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        if (set.fragments[f].children.count > 0) continue;
        forEachTriangle(set, f, [&](size_t p, uint32_t a, uint32_t b, uint32_t c) {
            if (set.geometry.primitives[p].exposedFrom > 0) result.push_back({a, b, c});
        });
    }
    return result;
}

/// Deepens `context.out.protrusion`; distances that cannot do so are not worked out.
void protrude(CheckContext& context, Solid& solid, const glm::dvec3& point) {
    if (solid.contains(point)) return;
    context.out.protrusion =
        std::max(context.out.protrusion, solid.distance(point, context.out.protrusion));
}

void checkVertices(CheckContext& context, Solid& solid, const Triangles& hidden) {
    const double tolerance = context.options.tolerance * context.out.diagonal;
    const std::vector<glm::vec3>& positions = context.set.geometry.positions;
    std::vector<bool> done(positions.size(), false);
    for (const auto& triangle : fragmentTriangles(context.set, 0))
        for (const uint32_t v : triangle) done[context.welded[v]] = true;
    uint32_t worst = 0;
    for (const auto& triangle : hidden) {
        for (const uint32_t corner : triangle) {
            const uint32_t v = context.welded[corner];
            if (done[v]) continue;
            done[v] = true;
            ++context.out.hiddenVertices;
            const glm::dvec3 point(positions[v]);
            if (solid.contains(point)) continue;
            const double enough = std::min(tolerance, context.out.protrusion);
            const double distance = solid.distance(point, enough);
            if (distance > context.out.protrusion) {
                context.out.protrusion = distance;
                worst = v;
            }
            if (distance > tolerance) ++context.out.verticesOutside;
        }
    }
    if (context.out.verticesOutside == 0) return;
    const glm::vec3 p = positions[worst];
    // An open surface has an inside by a vote only, and some have none at all.
    const bool open = context.out.boundaryEdges > 0;
    context.find(open ? Severity::note : Severity::failure, "hidden_outside", -1,
                 std::to_string(context.out.verticesOutside) +
                     " hidden vertices lie outside the object, the farthest by " +
                     shortNumber(context.out.protrusion) + " m at (" + shortNumber(p.x) + ", " +
                     shortNumber(p.y) + ", " + shortNumber(p.z) + ")",
                 "/geometry/attributes/POSITION");
}

}  // namespace

void checkHiddenInside(CheckContext& context) {
    const Triangles hidden = hiddenTriangles(context.set);
    if (hidden.empty()) return;
    Solid solid(context.set, context.out.boundaryEdges > 0);
    checkVertices(context, solid, hidden);
    const std::vector<glm::vec3>& positions = context.set.geometry.positions;
    for (const auto& triangle : hidden) {
        std::array<glm::dvec3, 3> p;
        for (int i = 0; i < 3; ++i) p[i] = glm::dvec3(positions[triangle[i]]);
        protrude(context, solid, (p[0] + p[1] + p[2]) / 3.0);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            // The triangle on the other side of the edge measures it the other way round.
            if (context.welded[triangle[i]] < context.welded[triangle[j]])
                protrude(context, solid, 0.5 * (p[i] + p[j]));
        }
    }
}

namespace {

/// Points evenly distributed in the object. std::mt19937 is the same everywhere.
std::vector<glm::dvec3> pointsInside(CheckContext& context, Solid& solid) {
    glm::dvec3 low(context.set.geometry.positions[0]);
    glm::dvec3 high = low;
    for (const auto& triangle : fragmentTriangles(context.set, 0))
        for (const uint32_t v : triangle)
            for (int a = 0; a < 3; ++a) {
                low[a] = std::min<double>(low[a], context.set.geometry.positions[v][a]);
                high[a] = std::max<double>(high[a], context.set.geometry.positions[v][a]);
            }
    std::mt19937 random(context.options.seed);
    const double nearFace = 1e-6 * context.out.diagonal;
    std::vector<glm::dvec3> points;
    // A thin shell fills little of its box; the limit ends the search on any input.
    for (uint64_t tries = 0; tries < uint64_t{200} * context.options.coveragePoints &&
                             points.size() < context.options.coveragePoints;
         ++tries) {
        glm::dvec3 point;
        for (int a = 0; a < 3; ++a)
            point[a] = low[a] + (high[a] - low[a]) * (random() / 4294967296.0);
        if (solid.contains(point) && solid.distance(point, nearFace) > nearFace)
            points.push_back(point);
    }
    return points;
}

void coverLevel(CheckContext& context, uint32_t level, const std::vector<glm::dvec3>& points) {
    Triangles triangles;
    std::vector<uint32_t> labels;
    for (const uint32_t f : fragmentsAtLevel(context.set, level))
        forEachTriangle(context.set, f, [&](size_t, uint32_t a, uint32_t b, uint32_t c) {
            triangles.push_back({a, b, c});
            labels.push_back(f);
        });
    const RayGrid grid(context.set.geometry.positions, triangles, labels, 2);
    const TriangleTree tree(context.set.geometry.positions, triangles);
    const double nearFace = 1e-6 * context.out.diagonal;
    size_t none = 0;
    size_t twice = 0;
    std::vector<RayGrid::Crossing> crossings;
    for (const glm::dvec3& point : points) {
        grid.crossings(point, crossings);
        std::sort(crossings.begin(), crossings.end(),
                  [](const auto& a, const auto& b) { return a.label < b.label; });
        uint32_t holders = 0;
        for (size_t i = 0; i < crossings.size();) {
            int winding = 0;
            const uint32_t label = crossings[i].label;
            for (; i < crossings.size() && crossings[i].label == label; ++i)
                winding += crossings[i].sign;
            holders += winding >= 1 ? 1 : 0;
        }
        if (holders == 1 || tree.distance(point, nearFace) <= nearFace) continue;
        if (holders == 0)
            ++none;
        else
            ++twice;
    }
    const double count = std::max<double>(1, static_cast<double>(points.size()));
    context.out.levels[level].coverageNone = static_cast<double>(none) / count;
    context.out.levels[level].coverageDouble = static_cast<double>(twice) / count;
}

}  // namespace

void measureCoverage(CheckContext& context) {
    Solid solid(context.set, context.out.boundaryEdges > 0);
    const std::vector<glm::dvec3> points = pointsInside(context, solid);
    for (uint32_t k = 0; k < context.set.levels.size(); ++k) coverLevel(context, k, points);
}

}  // namespace sherd
