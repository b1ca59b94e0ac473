// SPDX-License-Identifier: MIT
// Measures of how hidden faces look, taken from a fracture set alone: what they judge comes from
// the written positions and attributes, never from the code that made them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd::test {

inline const Attribute* attributeOf(const FractureSet& set, const std::string& semantic) {
    for (const Attribute& a : set.geometry.attributes)
        if (a.semantic == semantic) return &a;
    return nullptr;
}

struct SeenFace {
    const Primitive* primitive;
    std::array<uint32_t, 3> v;
    std::array<glm::dvec3, 3> p;
    glm::dvec3 normal;  ///< length: twice the area
};

inline std::vector<SeenFace> hiddenFacesOf(const FractureSet& set) {
    std::vector<SeenFace> faces;
    for (const Primitive& primitive : set.geometry.primitives) {
        if (primitive.exposedFrom == 0) continue;
        const Range r = primitive.indices;
        for (uint32_t i = r.first; i < r.first + r.count; i += 3) {
            SeenFace face{&primitive, {}, {}, {}};
            for (uint32_t k = 0; k < 3; ++k) {
                face.v[k] = set.geometry.indices[i + k];
                face.p[k] = set.geometry.positions[face.v[k]];
            }
            face.normal = glm::cross(face.p[1] - face.p[0], face.p[2] - face.p[0]);
            faces.push_back(face);
        }
    }
    return faces;
}

inline glm::dvec2 uvOf(const Attribute& uv, uint32_t vertex) {
    return {uv.values[2 * vertex], uv.values[2 * vertex + 1]};
}
inline glm::dvec3 vec3Of(const Attribute& a, uint32_t vertex) {
    const float* v = &a.values[a.components * vertex];
    return {v[0], v[1], v[2]};
}

/// The value below which `share` of the weight lies.
inline double percentile(std::vector<std::pair<double, double>> weighed, double share) {
    std::sort(weighed.begin(), weighed.end());
    double all = 0, below = 0;
    for (const auto& [value, weight] : weighed) all += weight;
    for (const auto& [value, weight] : weighed)
        if ((below += weight) >= share * all) return value;
    return weighed.empty() ? 0 : weighed.back().first;
}

/// Texels for each unit of area: UV area over area in space (so the square of what a length gets).
struct TexelDensity {
    double byArea = 0;   ///< p95 over p5, each face weighing as much as its area
    double byFace = 0;   ///< the same, each face weighing the same
    double mean = 0;     ///< tiles^2 per m^2
    double stretch = 0;  ///< p95 by area: the longer over the shorter side that a square texel gets
    double mirrored = 0;  ///< share of area
    size_t faces = 0;
};

/// Faces without area, below `least` m^2, have no texels and are left out.
inline TexelDensity texelDensity(const FractureSet& set, double least = 0) {
    const Attribute* uv = attributeOf(set, "TEXCOORD_0");
    TexelDensity result;
    if (uv == nullptr) return result;
    std::vector<std::pair<double, double>> byArea, byFace, stretch;
    double area = 0, uvArea = 0, mirrored = 0;
    for (const SeenFace& face : hiddenFacesOf(set)) {
        const double a = 0.5 * glm::length(face.normal);
        if (!(a > least)) continue;
        const glm::dvec2 s = uvOf(*uv, face.v[1]) - uvOf(*uv, face.v[0]);
        const glm::dvec2 t = uvOf(*uv, face.v[2]) - uvOf(*uv, face.v[0]);
        const double signedUv = 0.5 * (s.x * t.y - s.y * t.x);
        const double density = std::abs(signedUv) / a;
        byArea.emplace_back(density, a);
        byFace.emplace_back(density, 1);
        area += a;
        uvArea += std::abs(signedUv);
        // v runs down the picture: seen from outside its triangles run the other way round.
        if (signedUv > 0) mirrored += a;
        // Singular values of the map from the face's plane to UV.
        const glm::dvec3 e1 = glm::normalize(face.p[1] - face.p[0]);
        const glm::dvec3 e2 = glm::normalize(glm::cross(face.normal, e1));
        const double x1 = glm::dot(face.p[1] - face.p[0], e1);
        const double x2 = glm::dot(face.p[2] - face.p[0], e1);
        const double y2 = glm::dot(face.p[2] - face.p[0], e2);
        const glm::dvec2 du = s / x1;
        const glm::dvec2 dv = (t - s * (x2 / x1)) / y2;
        const double sum = glm::dot(du, du) + glm::dot(dv, dv);
        const double det = std::abs(du.x * dv.y - du.y * dv.x);
        const double root = std::sqrt(std::max(0.0, sum * sum / 4 - det * det));
        const double longer = std::sqrt(sum / 2 + root);
        const double shorter = std::sqrt(std::max(0.0, sum / 2 - root));
        stretch.emplace_back(shorter > 0 ? longer / shorter : 1e9, a);
    }
    result.faces = byFace.size();
    if (byFace.empty()) return result;
    result.byArea = percentile(byArea, 0.95) / percentile(byArea, 0.05);
    result.byFace = percentile(byFace, 0.95) / percentile(byFace, 0.05);
    result.mean = uvArea / area;
    result.stretch = percentile(stretch, 0.95);
    result.mirrored = mirrored / area;
    return result;
}

/// What is wrong with tangents of hidden faces, counted by corners.
struct TangentFaults {
    size_t corners = 0;
    size_t notUnit = 0;          ///< length or handedness
    size_t notAcross = 0;        ///< not at right angles to the normal
    size_t offU = 0;             ///< farther than `degrees` from where u grows on the face
    size_t wrongHandedness = 0;  ///< cross(normal, tangent) * w does not go against v
    size_t sum() const { return notUnit + notAcross + offU + wrongHandedness; }
};

/// The directions of u and v are worked out from positions and UV; faces without area or without
/// area in UV have none.
inline TangentFaults tangentFaults(const FractureSet& set, double degrees) {
    TangentFaults faults;
    const Attribute* normals = attributeOf(set, "NORMAL");
    const Attribute* tangents = attributeOf(set, "TANGENT");
    const Attribute* uv = attributeOf(set, "TEXCOORD_0");
    for (const SeenFace& face : hiddenFacesOf(set)) {
        const glm::dvec2 s = uvOf(*uv, face.v[1]) - uvOf(*uv, face.v[0]);
        const glm::dvec2 t = uvOf(*uv, face.v[2]) - uvOf(*uv, face.v[0]);
        const double det = s.x * t.y - s.y * t.x;
        const double longest = std::max({glm::length(s), glm::length(t), glm::length(s - t)});
        if (!(std::abs(det) > 1e-3 * longest * longest)) continue;  // too thin for float UV to say
        const glm::dvec3 e = face.p[1] - face.p[0];
        const glm::dvec3 f = face.p[2] - face.p[0];
        const glm::dvec3 alongU = (e * t.y - f * s.y) / det;
        const glm::dvec3 alongV = (f * s.x - e * t.x) / det;
        for (const uint32_t v : face.v) {
            ++faults.corners;
            const glm::dvec3 n = vec3Of(*normals, v);
            const glm::dvec3 tangent = vec3Of(*tangents, v);
            const double w = tangents->values[4 * v + 3];
            if (std::abs(glm::length(tangent) - 1) > 1e-4 || std::abs(w) != 1) ++faults.notUnit;
            if (std::abs(glm::dot(n, tangent)) > 1e-4) ++faults.notAcross;
            const glm::dvec3 inPlane = alongU - n * glm::dot(n, alongU);
            const double cosine = glm::dot(inPlane, tangent) / glm::length(inPlane);
            if (!(cosine > std::cos(degrees * M_PI / 180))) ++faults.offU;
            if (!(glm::dot(glm::cross(n, tangent) * w, alongV) < 0)) ++faults.wrongHandedness;
        }
    }
    return faults;
}

/// The hidden triangles that a fragment shows, each as all numbers of its three vertices, sorted.
inline std::vector<std::vector<float>> shownHidden(const FractureSet& set, uint32_t fragment) {
    std::vector<std::vector<float>> shown;
    const size_t primitives = set.geometry.primitives.size();
    for (size_t p = 0; p < primitives; ++p) {
        const uint32_t from = set.geometry.primitives[p].exposedFrom;
        if (from == 0 || from > set.fragments[fragment].level) continue;
        const Range range = set.fragmentRanges[fragment * primitives + p];
        for (uint32_t i = range.first; i < range.first + range.count; i += 3) {
            std::vector<float> numbers;
            for (uint32_t k = i; k < i + 3; ++k) {
                const uint32_t v = set.geometry.indices[k];
                const glm::vec3& q = set.geometry.positions[v];
                numbers.insert(numbers.end(), {q.x, q.y, q.z});
                for (const Attribute& a : set.geometry.attributes)
                    for (uint32_t c = 0; c < a.components; ++c)
                        numbers.push_back(a.values[a.components * v + c]);
            }
            shown.push_back(std::move(numbers));
        }
    }
    std::sort(shown.begin(), shown.end());
    return shown;
}

/// Hidden triangles of fragments with children that no child shows just so, down the hierarchy.
inline size_t facesThatChange(const FractureSet& set) {
    size_t changed = 0;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        const Range children = set.fragments[f].children;
        if (children.count == 0) continue;
        std::vector<std::vector<float>> below;
        for (uint32_t c = children.first; c < children.first + children.count; ++c) {
            auto shown = shownHidden(set, c);
            std::move(shown.begin(), shown.end(), std::back_inserter(below));
        }
        std::sort(below.begin(), below.end());
        for (const auto& triangle : shownHidden(set, f))
            changed += std::binary_search(below.begin(), below.end(), triangle) ? 0 : 1;
    }
    return changed;
}

}  // namespace sherd::test
