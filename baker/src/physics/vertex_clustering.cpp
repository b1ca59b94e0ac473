// SPDX-License-Identifier: MIT
// Vertex clustering (J. Rossignac and P. Borrel, Multi-resolution 3D approximations, 1993): it maps
// vertices, so what was closed stays so, as a chain; and it takes one pass.
#include "physics/vertex_clustering.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "geometry/bounds.h"

namespace sherd {

SolidChain clusterVertices(const SolidChain& solid, uint32_t cells) {
    Bounds box;
    for (const glm::dvec3& p : solid.points()) box.add(p);
    const glm::dvec3 size = box.size();
    const double perUnit = cells / std::max({size.x, size.y, size.z, 1e-300});
    std::vector<uint64_t> cellOf;
    for (const glm::dvec3& p : solid.points()) {
        const glm::dvec3 c = glm::min((p - box.low) * perUnit, glm::dvec3(cells - 1));
        cellOf.push_back((static_cast<uint64_t>(c.z) * cells + static_cast<uint64_t>(c.y)) * cells +
                         static_cast<uint64_t>(c.x));
    }
    std::vector<uint32_t> order(cellOf.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return cellOf[a] != cellOf[b] ? cellOf[a] < cellOf[b] : a < b;
    });
    std::vector<glm::dvec3> points;
    std::vector<uint32_t> left(order.size());
    for (size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || cellOf[order[i]] != cellOf[order[i - 1]])
            points.push_back(solid.points()[order[i]]);
        left[order[i]] = static_cast<uint32_t>(points.size()) - 1;
    }
    std::vector<std::array<uint32_t, 3>> skin;
    for (const auto& t : solid.skin()) {
        const std::array<uint32_t, 3> v{left[t[0]], left[t[1]], left[t[2]]};
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) skin.push_back(v);
    }
    return {std::move(points), std::move(skin)};
}

/// The solid angles of all triangles (A. van Oosterom and J. Strackee, 1983).
double windingNumber(const SolidChain& solid, const glm::dvec3& point) {
    double sum = 0;
    for (const auto& t : solid.skin()) {
        const glm::dvec3 a = solid.points()[t[0]] - point;
        const glm::dvec3 b = solid.points()[t[1]] - point;
        const glm::dvec3 c = solid.points()[t[2]] - point;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(
            glm::dot(a, glm::cross(b, c)),
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

}  // namespace sherd
