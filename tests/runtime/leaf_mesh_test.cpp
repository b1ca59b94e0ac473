// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "sherd/runtime/leaf_mesh.h"
#include "sherd/runtime/structure.h"
#include "support/fractured_cube.h"

using namespace sherd;

namespace {

using Triangle = std::array<uint32_t, 4>;  ///< material, and vertices of the asset

std::vector<Triangle> drawnByRanges(const Asset& asset, const std::vector<uint32_t>& standing) {
    std::vector<Triangle> triangles;
    const std::vector<uint32_t>& indices = asset.geometry().indices;
    for (const uint32_t fragment : standing)
        for (const DrawRange& range : asset.drawRanges(fragment))
            for (uint32_t i = 0; i < range.indices.count; i += 3) {
                const uint32_t* corner = &indices[range.indices.first + i];
                triangles.push_back({range.material, corner[0], corner[1], corner[2]});
            }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

/// As a shader would, from the table.
std::vector<Triangle> drawnByLeaves(const LeafMesh& mesh, const std::vector<LeafPose>& leaves) {
    std::vector<Triangle> triangles;
    for (const LeafMesh::Draw& draw : mesh.draws)
        for (uint32_t i = draw.indices.first; i < draw.indices.first + draw.indices.count; i += 3) {
            const uint32_t* corner = &mesh.indices[i];
            CHECK(mesh.leaves[corner[0]] == mesh.leaves[corner[1]]);
            CHECK(mesh.leaves[corner[0]] == mesh.leaves[corner[2]]);
            const uint32_t level = leaves[mesh.leaves[corner[0]]].level;
            if (level == LeafPose::kGone || mesh.exposedFrom[corner[0]] > level) continue;
            triangles.push_back({draw.material, mesh.vertices[corner[0]], mesh.vertices[corner[1]],
                                 mesh.vertices[corner[2]]});
        }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

std::vector<FragmentPose> posesOf(const Asset& asset, const std::vector<uint32_t>& standing) {
    std::vector<FragmentPose> poses;
    for (const uint32_t fragment : standing) {
        FragmentPose pose;
        pose.asset = &asset;
        pose.fragment = fragment;
        pose.pose.translation = asset.fragment(fragment).centerOfMass;
        poses.push_back(pose);
    }
    return poses;
}

}  // namespace

TEST_CASE("one draw per material shows what the ranges of the standing fragments show") {
    const auto asset = Asset::fromFractureSet(test::makeFracturedCube({})).value();
    const LeafMesh mesh = makeLeafMesh(*asset);
    CHECK(mesh.leaves.size() == mesh.vertices.size());
    for (size_t d = 1; d < mesh.draws.size(); ++d)
        CHECK(mesh.draws[d - 1].material < mesh.draws[d].material);
    Structure structure(asset);
    std::vector<uint32_t> standing{0};
    std::vector<LeafPose> leaves(asset->graph().leafCount());
    for (;;) {
        spreadOverLeaves(posesOf(*asset, standing), leaves);
        CHECK(drawnByLeaves(mesh, leaves) == drawnByRanges(*asset, standing));
        const auto divided = std::find_if(standing.begin(), standing.end(), [&](uint32_t f) {
            return asset->fragment(f).children.count > 0;
        });
        if (divided == standing.end()) break;
        const Range children = asset->fragment(*divided).children;
        standing.erase(divided);
        for (uint32_t c = 0; c < children.count; ++c) standing.push_back(children.first + c);
    }
    CHECK(standing.size() == leaves.size());
}

TEST_CASE("a leaf that was removed is not drawn, and the others are where their fragments are") {
    const auto asset = Asset::fromFractureSet(test::makeFracturedCube({})).value();
    std::vector<uint32_t> standing;
    const Range children = asset->fragment(0).children;
    for (uint32_t c = 1; c < children.count; ++c) standing.push_back(children.first + c);
    std::vector<LeafPose> leaves(asset->graph().leafCount());
    spreadOverLeaves(posesOf(*asset, standing), leaves);
    const Range gone = asset->graph().leavesOf(children.first);
    for (uint32_t leaf = 0; leaf < leaves.size(); ++leaf) {
        if (leaf - gone.first < gone.count) {
            CHECK(leaves[leaf].level == LeafPose::kGone);
            continue;
        }
        CHECK(leaves[leaf].level == 1);
        const uint32_t fragment = *std::find_if(standing.begin(), standing.end(), [&](uint32_t f) {
            return asset->graph().contains(f, leaf);
        });
        CHECK(leaves[leaf].pose.translation == asset->fragment(fragment).centerOfMass);
    }
}
