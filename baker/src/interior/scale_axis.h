// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "interior/vertex_rings.h"

namespace sherd {

/// For each ball the one that covers it when all are scaled, or itself; negative radii cover
/// nothing and are covered by whatever comes along. J. Giesen, B. Miklos, M. Pauly, C. Wormser,
/// "The Scale Axis Transform" (2009): the medial axis without the branches of small bumps and
/// noise. Balls are looked for along the mesh, from vertex to vertex, not across the solid: what a
/// bump is covered by lies below its own surroundings. The same for any number of threads.
std::vector<uint32_t> coveringBalls(std::span<const glm::vec3> centres,
                                    std::span<const float> radii, const VertexRings& rings,
                                    float scale, unsigned threads = 1);

}  // namespace sherd
