// SPDX-License-Identifier: MIT
#include "solid/far_side.h"

#include <glm/geometric.hpp>

#include "geometry/ray_hit.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

/// Shares of the diagonal: rays begin so far inside, past what is around their foot.
constexpr double kStart = 1e-6;
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
    : surface_(surface),
      topology_(topology),
      tree_(surface.positions, vertexTriangles(surface)),
      start_(kStart * boundsOf(surface).diagonal()) {
    normals_.reserve(surface.triangles.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        normals_.push_back(triangleNormal(surface, t));
}

glm::dvec3 FarSide::smoothNormal(uint32_t corner, const glm::dvec3& normal) const {
    glm::dvec3 sum(0.0);
    const auto add = [&](uint32_t c) {
        if (glm::dot(normals_[c / 3], normal) > kCrease) sum += normals_[c / 3];
    };
    uint32_t c = corner;
    do {
        add(c);
        c = topology_.opposite[nextCorner(nextCorner(c))];
    } while (c != kNone && c != corner);
    const double length = glm::length(sum);
    return length > 0 ? sum / length : normal;
}

std::optional<FarSide::Place> FarSide::behind(const glm::dvec3& from,
                                              const glm::dvec3& normal) const {
    const RayHit hit = firstHit(tree_, from - start_ * normal, -normal);
    if (hit.triangle == RayHit::kNone) return std::nullopt;
    if (!(glm::dot(normals_[hit.triangle], normal) < kOpposed)) return std::nullopt;
    return Place{from - (start_ + hit.t) * normal, hit.triangle};
}

std::optional<FarSide::Place> FarSide::across(uint32_t triangle, const glm::dvec3& weights) const {
    glm::dvec3 normal(0.0);
    for (uint32_t k = 0; k < 3; ++k)
        normal += weights[static_cast<int>(k)] * smoothNormal(3 * triangle + k, normals_[triangle]);
    const double length = glm::length(normal);
    if (!(length > 0)) return std::nullopt;
    return behind(pointOn(surface_, triangle, weights), normal / length);
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
