// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sherd/runtime/asset.h"
#include "sherd/runtime/events.h"

namespace sherd {

/// An object's geometry for drawing it, however broken, with one call per material: every vertex
/// belongs to one leaf, and a table of where the leaves are does the rest in the vertex shader.
/// Made once per asset.
///
/// The shader reads the pose of its vertex's leaf, and drops the triangle where the vertex's
/// `exposedFrom` is above the level of what stands there (moves it out of sight, say).
struct LeafMesh {
    struct Draw {
        uint32_t material = 0;  ///< index into FractureSet::materials
        Range indices;          ///< triangles
    };
    std::vector<uint32_t> vertices;     ///< into the asset's geometry; shared ones are repeated
    std::vector<uint32_t> leaves;       ///< per vertex: LEAF, as BondGraph numbers leaves
    std::vector<uint32_t> exposedFrom;  ///< per vertex: 0: outer surface; k: inside, above level k
    std::vector<uint32_t> indices;      ///< into these vertices
    std::vector<Draw> draws;            ///< one per material, ascending
};

LeafMesh makeLeafMesh(const Asset& asset);

/// What the shader must know of a leaf.
struct LeafPose {
    static constexpr uint32_t kGone = UINT32_MAX;

    RigidPose pose, previous;
    uint32_t level = kGone;  ///< of the fragment that stands for it; kGone: it was removed
    float scale = 1;
    float fade = 0;
};

/// Spreads the poses of one object, a run of `poses()`, over its leaves: as many as the graph has.
void spreadOverLeaves(std::span<const FragmentPose> poses, std::span<LeafPose> leaves);

}  // namespace sherd
