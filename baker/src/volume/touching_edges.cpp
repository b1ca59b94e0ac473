// SPDX-License-Identifier: MIT
#include "volume/touching_edges.h"

#include <glm/vec3.hpp>
#include <map>
#include <utility>

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

struct Halved {
    uint32_t a, b, middle;
};

/// Which corner of the triangle the halved edge leaves.
size_t edgeOf(const Triangle& v, const Halved& h) {
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t from = v[k], to = v[(k + 1) % 3];
        if ((from == h.a && to == h.b) || (from == h.b && to == h.a)) return k;
    }
    return 0;
}

/// The half at the edge's start and that at its end.
std::array<Triangle, 2> halvesOf(const Triangle& v, size_t k, uint32_t middle) {
    Triangle first = v, second = v;
    first[(k + 1) % 3] = middle;
    second[k] = middle;
    return {first, second};
}

void halveSkin(MeshCut& cut, const std::map<CutTriangleId, Halved>& halved) {
    std::vector<MeshCut::SkinTriangle> skin;
    std::vector<uint32_t> start{0};
    for (uint32_t cell = 0; cell < cut.cells(); ++cell) {
        for (uint32_t s = cut.skinStart[cell]; s < cut.skinStart[cell + 1]; ++s) {
            const MeshCut::SkinTriangle& t = cut.skin[s];
            const auto it = halved.find(s);
            if (it == halved.end()) {
                skin.push_back(t);
                continue;
            }
            const size_t k = edgeOf(t.v, it->second);
            const auto halves = halvesOf(t.v, k, it->second.middle);
            MeshCut::CornerWeights whole{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                         glm::dvec3(0, 0, 1)};
            if (t.weights != MeshCut::kWhole) whole = cut.weights[t.weights];
            const glm::dvec3 middle = (whole[k] + whole[(k + 1) % 3]) * 0.5;
            for (size_t half = 0; half < 2; ++half) {
                MeshCut::CornerWeights weights = whole;
                weights[half == 0 ? (k + 1) % 3 : k] = middle;
                skin.push_back({halves[half], t.source, static_cast<uint32_t>(cut.weights.size())});
                cut.weights.push_back(weights);
            }
        }
        start.push_back(static_cast<uint32_t>(skin.size()));
    }
    cut.skin = std::move(skin);
    cut.skinStart = std::move(start);
}

void halveCaps(MeshCut& cut, uint32_t firstId, const std::map<CutTriangleId, Halved>& halved) {
    std::vector<CapTriangle> triangles;
    for (MeshCut::Cap& cap : cut.caps) {
        const auto first = static_cast<uint32_t>(triangles.size());
        for (uint32_t t = cap.first; t < cap.first + cap.count; ++t) {
            const CapTriangle& whole = cut.capTriangles[t];
            const auto it = halved.find(firstId + t);
            if (it == halved.end()) {
                triangles.push_back(whole);
                continue;
            }
            for (const Triangle& half :
                 halvesOf(whole.v, edgeOf(whole.v, it->second), it->second.middle))
                triangles.push_back({half, whole.layer});
        }
        cap.first = first;
        cap.count = static_cast<uint32_t>(triangles.size()) - first;
    }
    cut.capTriangles = std::move(triangles);
}

}  // namespace

void halveEdges(MeshCut& cut, std::span<const EdgeUse> uses) {
    std::map<CutTriangleId, Halved> halved;
    const auto firstCap = static_cast<uint32_t>(cut.skin.size());
    for (const EdgeUse& use : uses) {
        const auto middle = static_cast<uint32_t>(cut.positions.size());
        cut.positions.emplace_back(
            (glm::dvec3(cut.positions[use.a]) + glm::dvec3(cut.positions[use.b])) * 0.5);
        for (const CutTriangleId t : use.triangles) halved[t] = {use.a, use.b, middle};
    }
    halveSkin(cut, halved);
    halveCaps(cut, firstCap, halved);
}

}  // namespace sherd
