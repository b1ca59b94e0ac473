// SPDX-License-Identifier: MIT
#include "assembly/outer_vertices.h"

#include <algorithm>
#include <cmath>

#include "surface/mesh_topology.h"

namespace sherd {
namespace {

/// Interpolated directions are brought back to unit length; a vanishing one keeps the first
/// source's.
void normalise(float* value, const float* fallback) {
    const double length = std::hypot(value[0], value[1], value[2]);
    for (int i = 0; i < 3; ++i) {
        value[i] = length > 1e-12 ? static_cast<float>(value[i] / length) : fallback[i];
    }
}

}  // namespace

OuterVertices::OuterVertices(const SurfaceMesh& mesh, const SplitSurface& surface,
                             FractureGeometry& out)
    : mesh_(mesh), surface_(surface), out_(out) {
    const size_t count = mesh.attributes.empty()
                             ? 0
                             : mesh.attributes[0].values.size() / mesh.attributes[0].components;
    unsplit_.assign(count, kNone);
    for (const Attribute& attribute : mesh.attributes) {
        out_.attributes.push_back({attribute.semantic, attribute.components, {}});
        out_.attributes.back().values.reserve(attribute.values.size() * 3);
    }
}

size_t OuterVertices::KeyHash::operator()(const Key& key) const {
    uint64_t h = key.splitVertex * 0x9E3779B97F4A7C15ULL;
    h = (h ^ key.a ^ h >> 29) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ key.b ^ h >> 32) * 0x94D049BB133111EBULL;
    return static_cast<size_t>(h ^ h >> 31);
}

uint32_t OuterVertices::vertex(const SplitTriangle& triangle, uint32_t k) {
    const uint32_t v = triangle.v[k];
    const auto& sourceVertices = mesh_.triangles[triangle.source];
    const auto& sourceCorners = mesh_.corners[triangle.source];
    const auto cornerOf = [&](uint32_t meshVertex) {
        const auto it = std::find(sourceVertices.begin(), sourceVertices.end(), meshVertex);
        return sourceCorners[static_cast<size_t>(it - sourceVertices.begin())];
    };
    if (v < surface_.meshVertices) return meshVertex(v, cornerOf(v));

    const VertexOrigin& origin = surface_.origins[v];
    const std::array<uint32_t, 3> sources{
        cornerOf(origin.vertices[0]), cornerOf(origin.vertices[1]), cornerOf(origin.vertices[2])};
    const auto [it, isNew] = split_.try_emplace(Key{v, sources[0], sources[1]}, 0);
    if (isNew) it->second = newVertex(v, sources, origin.weights);
    return it->second;
}

uint32_t OuterVertices::meshVertex(uint32_t splitVertex, uint32_t attributeVertex) {
    uint32_t& known = unsplit_[attributeVertex];
    if (known != kNone && out_.positions[known] == surface_.positions[splitVertex]) return known;
    const std::array<uint32_t, 3> sources{attributeVertex, attributeVertex, attributeVertex};
    if (known == kNone) return known = newVertex(splitVertex, sources, {1, 0, 0});
    // An attribute vertex that several positions share.
    const auto [it, isNew] =
        split_.try_emplace(Key{splitVertex, attributeVertex, attributeVertex}, 0);
    if (isNew) it->second = newVertex(splitVertex, sources, {1, 0, 0});
    return it->second;
}

uint32_t OuterVertices::newVertex(uint32_t splitVertex, const std::array<uint32_t, 3>& sources,
                                  const glm::dvec3& weights) {
    const bool copied = weights[0] == 1;
    for (size_t a = 0; a < mesh_.attributes.size(); ++a) {
        const Attribute& from = mesh_.attributes[a];
        std::vector<float>& to = out_.attributes[a].values;
        const size_t begin = to.size();
        const auto value = [&](size_t source, uint32_t c) {
            return from.values[sources[source] * from.components + c];
        };
        for (uint32_t c = 0; c < from.components; ++c) {
            if (copied) {
                to.push_back(value(0, c));
            } else {
                double sum = 0;
                for (size_t s = 0; s < 3; ++s) sum += weights[static_cast<int>(s)] * value(s, c);
                to.push_back(static_cast<float>(sum));
            }
        }
        if (copied) continue;
        const float* first = from.values.data() + size_t{sources[0]} * from.components;
        if (from.semantic == "NORMAL" || from.semantic == "TANGENT") normalise(&to[begin], first);
        if (from.semantic == "TANGENT")
            to[begin + 3] = first[3];  // handedness is one side's or the other's
    }
    out_.positions.push_back(surface_.positions[splitVertex]);
    return static_cast<uint32_t>(out_.positions.size() - 1);
}

}  // namespace sherd
