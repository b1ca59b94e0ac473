// SPDX-License-Identifier: MIT
#include "sherd/runtime/leaf_mesh.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace sherd {
namespace {

/// Adds the triangles of one leaf in one primitive, with vertices of their own.
void addTriangles(const Asset& asset, uint32_t leaf, const Primitive& primitive, Range triangles,
                  LeafMesh& mesh) {
    std::unordered_map<uint32_t, uint32_t> copies;
    copies.reserve(triangles.count);
    for (uint32_t i = triangles.first; i < triangles.first + triangles.count; ++i) {
        const uint32_t vertex = asset.geometry().indices[i];
        const auto [copy, isNew] = copies.emplace(vertex, uint32_t(mesh.vertices.size()));
        if (isNew) {
            mesh.vertices.push_back(vertex);
            mesh.leaves.push_back(leaf);
            mesh.exposedFrom.push_back(primitive.exposedFrom);
        }
        mesh.indices.push_back(copy->second);
    }
}

}  // namespace

LeafMesh makeLeafMesh(const Asset& asset) {
    const std::vector<Primitive>& primitives = asset.geometry().primitives;
    std::map<uint32_t, std::vector<uint32_t>> byMaterial;
    for (uint32_t p = 0; p < primitives.size(); ++p)
        byMaterial[primitives[p].material].push_back(p);
    LeafMesh mesh;
    for (const auto& [material, ones] : byMaterial) {
        const auto first = uint32_t(mesh.indices.size());
        for (const uint32_t p : ones)
            for (uint32_t leaf = 0; leaf < asset.graph().leafCount(); ++leaf) {
                const size_t range = asset.graph().fragmentOfLeaf(leaf) * primitives.size() + p;
                addTriangles(asset, leaf, primitives[p], asset.set().fragmentRanges[range], mesh);
            }
        const uint32_t count = uint32_t(mesh.indices.size()) - first;
        if (count > 0) mesh.draws.push_back({material, {first, count}});
    }
    return mesh;
}

void spreadOverLeaves(std::span<const FragmentPose> poses, std::span<LeafPose> leaves) {
    std::fill(leaves.begin(), leaves.end(), LeafPose{});
    for (const FragmentPose& pose : poses) {
        const Range range = pose.asset->graph().leavesOf(pose.fragment);
        const LeafPose leaf{pose.pose, pose.previous, pose.asset->fragment(pose.fragment).level,
                            pose.scale, pose.fade};
        for (uint32_t l = range.first; l < range.first + range.count && l < leaves.size(); ++l)
            leaves[l] = leaf;
    }
}

}  // namespace sherd
