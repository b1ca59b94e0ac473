// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "check_context.h"

namespace sherd {

namespace {

bool differ(double a, double b, double relative) {
    return std::abs(a - b) > relative * std::max(std::abs(a), std::abs(b));
}

void checkLeafMass(CheckContext& context, uint32_t f) {
    const Fragment& leaf = context.set.fragments[f];
    const MeshMeasures& mesh = context.measures[f];
    const auto id = static_cast<int32_t>(f);
    if (differ(leaf.mass, double{leaf.density} * leaf.volume, 1e-3))
        context.find(Severity::failure, "mass_wrong", id,
                     "MASS says " + shortNumber(leaf.mass) + " kg, DENSITY times VOLUME is " +
                         shortNumber(double{leaf.density} * leaf.volume),
                     "/fragments/attributes/MASS");
    const double off = glm::length(glm::dvec3(leaf.centerOfMass) - mesh.centroid);
    // A coordinate far from the origin is rounded to 2^-24 of its size, a centroid to a few times
    // that.
    const double rounding = 1e-6 * glm::length(mesh.centroid);
    if (mesh.edges.count == 0 && mesh.volume > 0 && off > 1e-3 * context.out.diagonal + rounding)
        context.find(Severity::failure, "center_of_mass_wrong", id,
                     "CENTER_OF_MASS lies " + shortNumber(off) + " m from the mesh's centroid",
                     "/fragments/attributes/CENTER_OF_MASS");
}

void checkMassSum(CheckContext& context, uint32_t f) {
    const Fragment& parent = context.set.fragments[f];
    double mass = 0;
    double volume = 0;
    for (uint32_t c = 0; c < parent.children.count; ++c) {
        mass += context.set.fragments[parent.children.first + c].mass;
        volume += context.set.fragments[parent.children.first + c].volume;
    }
    const auto id = static_cast<int32_t>(f);
    if (differ(parent.mass, mass, 1e-4))
        context.find(
            Severity::failure, "mass_sum", id,
            "MASS says " + shortNumber(parent.mass) + " kg, its children have " + shortNumber(mass),
            "/fragments/attributes/MASS");
    // Core and all, or the pieces alone: either is a volume of the object.
    const bool isMeshVolume = f == 0 && !differ(parent.volume, context.measures[0].volume, 1e-3);
    if (differ(parent.volume, volume, 1e-4) && !isMeshVolume)
        context.find(Severity::failure, "volume_wrong", id,
                     "VOLUME says " + shortNumber(parent.volume) + " m^3, its children have " +
                         shortNumber(volume),
                     "/fragments/attributes/VOLUME");
}

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

void checkHulls(CheckContext& context) {
    const FractureSet& set = context.set;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        const Range hulls = set.fragments[f].hulls;
        const auto id = static_cast<int32_t>(f);
        if (hulls.count == 0)
            context.find(Severity::warning, "no_collider", id, "it has no convex hull",
                         "/fragments/attributes/HULLS");
        for (uint32_t h = hulls.first; h < hulls.first + hulls.count; ++h) {
            const Range points = set.hulls[h].points;
            const double depth = points.count < 4 ? 0 : thickness(set.hullPoints, points);
            if (!(depth > 1e-9 * context.out.diagonal))
                context.find(Severity::failure, "hull_flat", id,
                             "hull " + std::to_string(h) + " with " + std::to_string(points.count) +
                                 " points has no volume",
                             "/hulls/points");
        }
    }
}

void checkBonds(CheckContext& context) {
    const std::vector<Bond>& bonds = context.set.bonds;
    for (size_t b = 0; b < bonds.size(); ++b) {
        if (bonds[b].area > 0) continue;
        context.find(Severity::failure, "bond_area", bonds[b].a,
                     "bond " + std::to_string(b) + " has no area", "/bonds/attributes/AREA");
    }
}

}  // namespace

void checkMass(CheckContext& context) {
    for (uint32_t f = 0; f < context.set.fragments.size(); ++f) {
        if (context.set.fragments[f].children.count > 0)
            checkMassSum(context, f);
        else
            checkLeafMass(context, f);
    }
}

void checkHullsAndBonds(CheckContext& context) {
    checkHulls(context);
    checkBonds(context);
}

}  // namespace sherd
