// SPDX-License-Identifier: MIT
#include "appearance/outer_shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

using Corners = std::array<glm::dvec3, 3>;

Corners normalsOf(const Attribute& normals, const std::array<uint32_t, 3>& corners) {
    Corners result;
    for (size_t k = 0; k < 3; ++k) {
        const float* n = normals.values.data() + size_t{normals.components} * corners[k];
        result[k] = {n[0], n[1], n[2]};
    }
    return result;
}

glm::dvec3 weighted(const Corners& p, const glm::dvec3& w) {
    return w.x * p[0] + w.y * p[1] + w.z * p[2];
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / M_PI;
}

/// Places in a triangle where the two ways to interpolate are compared: those between its corners.
constexpr std::array<std::array<double, 3>, 7> kPlaces{{{0.5, 0.5, 0},
                                                        {0, 0.5, 0.5},
                                                        {0.5, 0, 0.5},
                                                        {1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                        {0.6, 0.2, 0.2},
                                                        {0.2, 0.6, 0.2},
                                                        {0.2, 0.2, 0.6}}};

}  // namespace

ShadingShift shadingShift(const SurfaceMesh& mesh, const SplitSurface& surface, double least) {
    ShadingShift result;
    const Attribute* normals = findAttribute(mesh.attributes, "NORMAL");
    if (normals == nullptr) return result;
    uint32_t last = std::numeric_limits<uint32_t>::max();  // triangle counted; they are in order
    for (const SplitTriangle& triangle : surface.triangles) {
        const auto isNew = [&](uint32_t v) { return v >= surface.meshVertices; };
        if (mesh.isCap(triangle.source) ||
            std::none_of(triangle.v.begin(), triangle.v.end(), isNew))
            continue;
        const Corners whole = normalsOf(*normals, mesh.corners[triangle.source]);
        Corners part, unit, places;
        for (size_t k = 0; k < 3; ++k) {
            const VertexOrigin& origin = surface.origins[triangle.v[k]];
            part[k] = weighted(whole, weightsOf(origin, mesh.triangles[triangle.source]));
            unit[k] = glm::length(part[k]) > 0 ? glm::normalize(part[k]) : part[k];
            places[k] = surface.positions[triangle.v[k]];
        }
        for (const auto& [u, v, w] : kPlaces) {
            const glm::dvec3 weights(u, v, w);
            const glm::dvec3 before = weighted(part, weights), after = weighted(unit, weights);
            const double turned = degreesBetween(before, after);
            if (!(turned > least)) continue;
            if (last != triangle.source) ++result.triangles;
            last = triangle.source;
            if (turned <= result.degrees) continue;
            result.degrees = turned;
            result.place = weighted(places, weights);
        }
    }
    return result;
}

}  // namespace sherd
