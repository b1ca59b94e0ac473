// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "interior/ball_tree.h"
#include "interior/vertex_rings.h"

namespace sherd {

/// Meshes of fewer vertices are too coarse for balls to learn from one another.
inline constexpr size_t kManyVertices = 4096;

/// The largest tangent ball at every vertex of a mesh. Only a sample of the vertices searches the
/// whole surface; the others learn from their neighbours what their ball touches. Vertices without
/// a normal (0) or without neighbours get balls of radius 0. The same for any number of threads.
std::vector<BallTree::Ball> vertexBalls(const BallTree& tree,
                                        std::span<const std::array<uint32_t, 3>> triangles,
                                        std::span<const BallTree::Tangent> tangents,
                                        const VertexRings& rings, float maxRadius,
                                        unsigned threads);

}  // namespace sherd
