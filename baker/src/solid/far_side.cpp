// SPDX-License-Identifier: MIT
#include "solid/far_side.h"

#include <glm/geometric.hpp>

#include "geometry/ray_hit.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

/// Faces that turn more than this against each other meet at a crease.
constexpr double kCrease = 0.77;  // cosine of 40 degrees
/// The far side faces away by at least 120 degrees.
constexpr double kOpposed = -0.5;

glm::dvec3 triangleNormal(const SplitSurface& surface, uint32_t triangle) {
    const auto& v = surface.triangles[triangle].v;
    const glm::dvec3 a = surface.positions[v[0]];
    const glm::dvec3 n = glm::cross(glm::dvec3(surface.positions[v[1]]) - a,
                                    glm::dvec3(surface.positions[v[2]]) - a);
    const double length = glm::length(n);
    return length > 0 ? n / length : glm::dvec3(0.0);
}

}  // namespace

FarSide::FarSide(const SplitSurface& surface, const MeshTopology& topology)
    : surface_(surface), topology_(topology), tree_(surface.positions, vertexTriangles(surface)) {
    normals_.reserve(surface.triangles.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        normals_.push_back(triangleNormal(surface, t));
}

/// The mean of the faces around a corner that make one smooth surface with its own.
glm::dvec3 FarSide::cornerNormal(uint32_t corner) const {
    const glm::dvec3 own = normals_[corner / 3];
    glm::dvec3 sum = own;
    uint32_t c = corner;
    do {
        const uint32_t o = topology_.opposite[nextCorner(nextCorner(c))];
        if (o == kNone || o == corner) break;
        c = o;
        if (glm::dot(normals_[c / 3], own) > kCrease) sum += normals_[c / 3];
    } while (c != corner);
    const double length = glm::length(sum);
    return length > 0 ? sum / length : own;
}

std::optional<FarSide::Place> FarSide::across(uint32_t triangle, const glm::dvec3& weights) const {
    glm::dvec3 normal(0.0);
    for (uint32_t k = 0; k < 3; ++k)
        normal += weights[static_cast<int>(k)] * cornerNormal(3 * triangle + k);
    const double length = glm::length(normal);
    if (!(length > 0)) return std::nullopt;
    normal /= length;
    const glm::dvec3 from = pointOn(surface_, triangle, weights);
    const RayHit hit = firstHit(tree_, from, -normal, triangle);
    if (hit.triangle == RayHit::kNone) return std::nullopt;
    if (!(glm::dot(normals_[hit.triangle], normal) < kOpposed)) return std::nullopt;
    return Place{from - hit.t * normal, hit.triangle};
}

std::optional<FarSide::Place> FarSide::acrossFrom(uint32_t triangle) const {
    const auto middle = across(triangle, glm::dvec3(1.0 / 3));
    if (!middle) return std::nullopt;
    std::array<glm::dvec3, 3> far{};
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 weights(0.1);
        weights[k] = 0.8;
        const auto place = across(triangle, weights);
        if (!place) return std::nullopt;
        far[static_cast<size_t>(k)] = place->position;
    }
    const glm::dvec3 turn = glm::cross(far[1] - far[0], far[2] - far[0]);
    if (!(glm::dot(turn, normals_[triangle]) > 0)) return std::nullopt;
    return middle;
}

}  // namespace sherd
