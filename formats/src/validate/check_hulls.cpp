// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "check_context.h"
#include "sherd/formats/hull_measures.h"

namespace sherd {

namespace {

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::max()};
    glm::dvec3 high{-std::numeric_limits<double>::max()};
};

/// How thick the points are: 0 in a plane. Extremes are chosen greedily, as a hull builder starts.
double thickness(const std::vector<glm::vec3>& points, const Range& range) {
    const auto at = [&](uint32_t i) { return glm::dvec3(points[range.first + i]); };
    const auto farthest = [&](auto measure) {
        uint32_t best = 0;
        for (uint32_t i = 1; i < range.count; ++i)
            if (measure(at(i)) > measure(at(best))) best = i;
        return at(best);
    };
    const glm::dvec3 a = at(0);
    const glm::dvec3 b = farthest([&](const glm::dvec3& p) { return glm::distance(a, p); });
    const glm::dvec3 c =
        farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(b - a, p - a)); });
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    if (!(length > 0)) return 0;
    const auto height = [&](const glm::dvec3& p) { return std::abs(glm::dot(p - a, n)) / length; };
    return height(farthest(height));
}

void checkShape(CheckContext& context, int32_t f, uint32_t h) {
    const Range points = context.set.hulls[h].points;
    const double depth = points.count < 4 ? 0 : thickness(context.set.hullPoints, points);
    if (!(depth > 1e-9 * context.out.diagonal))
        context.find(Severity::failure, "hull_flat", f,
                     "hull " + std::to_string(h) + " with " + std::to_string(points.count) +
                         " points has no volume",
                     "/hulls/points");
}

/// The box around the hull as it collides, its margin put on.
Box grownBox(const FractureSet& set, uint32_t h) {
    const Range points = set.hulls[h].points;
    Box box;
    for (uint32_t i = points.first; i < points.first + points.count; ++i) {
        box.low = glm::min(box.low, glm::dvec3(set.hullPoints[i]));
        box.high = glm::max(box.high, glm::dvec3(set.hullPoints[i]));
    }
    box.low -= double{set.hulls[h].margin};
    box.high += double{set.hulls[h].margin};
    return box;
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// Points are moved inwards by the margin, so the hull as it collides stays in the fragment's box.
void checkInsideBox(CheckContext& context, int32_t f, uint32_t h, const Box& box) {
    const MeshMeasures& mesh = context.measures[static_cast<size_t>(f)];
    const double reach = largest(glm::max(glm::abs(mesh.low), glm::abs(mesh.high)));
    // The collider of a flat fragment needs some thickness, that of a point some size.
    const double allowed =
        1e-5 * context.out.diagonal + 1e-3 * largest(mesh.high - mesh.low) + 2e-5 * reach;
    const double out = largest(glm::max(mesh.low - box.low, box.high - mesh.high));
    if (out > allowed)
        context.find(Severity::failure, "hull_outside", f,
                     "hull " + std::to_string(h) + " with its margin reaches " + shortNumber(out) +
                         " m out of the fragment's bounding box",
                     "/hulls/points");
}

void checkReach(CheckContext& context, int32_t f, const Box& box, double margin) {
    const MeshMeasures& mesh = context.measures[static_cast<size_t>(f)];
    const glm::dvec3 extent = mesh.high - mesh.low;
    for (int a = 0; a < 3; ++a) {
        if (extent[a] < 10 * margin || box.high[a] - box.low[a] >= 0.3 * extent[a]) continue;
        return context.find(Severity::warning, "hull_small", f,
                            "its hulls reach " + shortNumber(box.high[a] - box.low[a]) +
                                " m along " + std::string(1, "xyz"[a]) + ", the fragment " +
                                shortNumber(extent[a]),
                            "/fragments/attributes/HULLS");
    }
}

/// Bodies of overlapping colliders would be pushed apart as soon as they come to be.
void checkApart(CheckContext& context) {
    const ColliderOverlaps found =
        colliderOverlaps(context.set, context.options.tolerance * context.out.diagonal);
    for (const ColliderOverlap& overlap : found.pairs)
        context.find(Severity::warning, "hull_overlap", static_cast<int32_t>(overlap.a),
                     "its hulls and those of fragment " + std::to_string(overlap.b) +
                         " are inside each other by " + shortNumber(overlap.depth) + " m",
                     "/hulls/points");
    if (!found.complete)
        context.find(Severity::note, "overlaps_uncounted", -1,
                     "too many hulls lie in one place to hold each against each", "/hulls/points");
}

}  // namespace

void checkHulls(CheckContext& context) {
    const FractureSet& set = context.set;
    std::vector<int32_t> owner(set.hulls.size(), -1);
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        const Range hulls = set.fragments[f].hulls;
        const auto id = static_cast<int32_t>(f);
        if (hulls.count == 0) {
            context.find(Severity::warning, "no_collider", id, "it has no convex hull",
                         "/fragments/attributes/HULLS");
            continue;
        }
        Box all;
        double margin = 0;
        for (uint32_t h = hulls.first; h < hulls.first + hulls.count; ++h) {
            checkShape(context, id, h);
            const Box box = grownBox(set, h);
            checkInsideBox(context, id, h, box);
            all.low = glm::min(all.low, box.low);
            all.high = glm::max(all.high, box.high);
            margin = std::max(margin, double{set.hulls[h].margin});
            if (owner[h] >= 0)
                context.find(Severity::warning, "hull_shared", id,
                             "hull " + std::to_string(h) + " is also that of fragment " +
                                 std::to_string(owner[h]),
                             "/fragments/attributes/HULLS");
            owner[h] = id;
        }
        checkReach(context, id, all, margin);
    }
    checkApart(context);
}

}  // namespace sherd
