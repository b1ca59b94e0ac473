// SPDX-License-Identifier: MIT
// What fragments are like: how much of them is broken surface, whether they pass through
// themselves, how thin they are. Fragment by fragment, level by level, from what each shows.
#include <algorithm>
#include <glm/geometric.hpp>

#include "check_context.h"
#include "crossing_triangles.h"
#include "thin_parts.h"

namespace sherd {

namespace {

constexpr uint32_t kThicknessPoints = 400;
constexpr double kThinShare = 0.1;

struct Areas {
    double outer = 0;
    double hidden = 0;
};

Areas areasOf(const FractureSet& set, uint32_t fragment) {
    const std::vector<glm::vec3>& at = set.geometry.positions;
    Areas areas;
    forEachTriangle(set, fragment, [&](size_t p, uint32_t a, uint32_t b, uint32_t c) {
        const glm::dvec3 corner(at[a]);
        const double twice =
            glm::length(glm::cross(glm::dvec3(at[b]) - corner, glm::dvec3(at[c]) - corner));
        (set.geometry.primitives[p].exposedFrom > 0 ? areas.hidden : areas.outer) += twice / 2;
    });
    return areas;
}

}  // namespace

void measureHiddenArea(CheckContext& context) {
    for (uint32_t k = 0; k < context.set.levels.size(); ++k) {
        Areas sum;
        for (const uint32_t f : fragmentsAtLevel(context.set, k)) {
            const Areas areas = areasOf(context.set, f);
            sum.outer += areas.outer;
            sum.hidden += areas.hidden;
        }
        const double whole = sum.outer + sum.hidden;
        context.out.levels[k].hiddenShare = whole > 0 ? sum.hidden / whole : 0;
    }
}

void measureShapes(CheckContext& context) {
    const std::vector<glm::vec3>& positions = context.set.geometry.positions;
    std::vector<uint64_t> crossings;
    std::vector<double> thinnest;
    for (uint32_t f = 0; f < context.set.fragments.size(); ++f) {
        const auto triangles = fragmentTriangles(context.set, f);
        const CrossingCount count = countCrossings(positions, triangles);
        crossings.push_back(count.pairs);
        thinnest.push_back(thinnestPart(positions, triangles, kThicknessPoints, kThinShare,
                                        context.options.seed + f));
        if (!count.complete)
            context.find(Severity::note, "crossings_uncounted", static_cast<int32_t>(f),
                         "so many triangles lie in one place that not all crossings were counted",
                         "/geometry");
    }
    for (uint32_t k = 0; k < context.set.levels.size(); ++k) {
        LevelReport& level = context.out.levels[k];
        level.selfIntersections = 0;
        for (const uint32_t f : fragmentsAtLevel(context.set, k)) {
            level.selfIntersections += static_cast<int64_t>(crossings[f]);
            if (thinnest[f] > 0 && (level.thinnest < 0 || thinnest[f] < level.thinnest))
                level.thinnest = thinnest[f];
        }
    }
    const auto worst = std::max_element(crossings.begin(), crossings.end());
    if (worst != crossings.end() && *worst > 0)
        context.find(Severity::note, "self_intersecting",
                     static_cast<int32_t>(worst - crossings.begin()),
                     std::to_string(*worst) +
                         " pairs of its triangles cross or overlap, more than "
                         "in any other fragment",
                     "/geometry");
}

}  // namespace sherd
