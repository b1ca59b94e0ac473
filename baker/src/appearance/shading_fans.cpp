// SPDX-License-Identifier: MIT
#include "appearance/shading_fans.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

/// Faces at a smaller angle are one facet: a wall's two triangles differ by rounding.
constexpr double kFacetDegrees = 0.2;

}  // namespace

ShadingFans shadingFans(const HiddenMesh& mesh, std::span<const uint32_t> opposite,
                        const FaceShapes& shapes, const InteriorSettings& settings) {
    const auto& [normals, areas] = shapes;
    const auto cosine = [](double degrees) { return std::cos(degrees * M_PI / 180); };
    const double facet = cosine(kFacetDegrees);
    const double crease = settings.normals == InteriorNormals::flat
                              ? facet
                              : std::min(facet, cosine(settings.creaseAngle));
    const auto corners = static_cast<uint32_t>(3 * mesh.faces.size());
    UnionFind fans(corners);
    for (uint32_t h = 0; h < corners; ++h) {
        const uint32_t o = opposite[h];
        if (o == kNone || o < h) continue;
        const double least = mesh.faces[h / 3].wall ? facet : crease;
        // A face without area has no direction: it must not join those on its two sides.
        const bool areaLess = areas[h / 3] == 0 || areas[o / 3] == 0;
        if (areaLess || glm::dot(normals[h / 3], normals[o / 3]) < least) continue;
        fans.unite(h, nextCorner(o));
        fans.unite(nextCorner(h), o);
    }
    ShadingFans result;
    result.ofCorner.resize(corners);
    for (uint32_t c = 0; c < corners; ++c) {
        const uint32_t root = fans.find(c);
        if (root == c) {
            result.ofCorner[c] = static_cast<uint32_t>(result.normals.size());
            result.normals.emplace_back(0.0);
        }
        result.ofCorner[c] = result.ofCorner[root];
        result.normals[result.ofCorner[c]] += normals[c / 3] * areas[c / 3];
    }
    for (glm::dvec3& n : result.normals) {
        const double length = glm::length(n);
        n = length > 0 ? n / length : glm::dvec3(0.0);
    }
    // Where a fan bends on and on, a face must not be lit from behind.
    for (uint32_t c = 0; c < corners; ++c) {
        if (areas[c / 3] == 0 || glm::dot(normals[c / 3], result.normals[result.ofCorner[c]]) > 0)
            continue;
        result.ofCorner[c] = static_cast<uint32_t>(result.normals.size());
        result.normals.push_back(normals[c / 3]);
    }
    return result;
}

}  // namespace sherd
