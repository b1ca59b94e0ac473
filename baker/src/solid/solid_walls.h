// SPDX-License-Identifier: MIT
// Walls straight through the solid between the lines that part two pieces (thesis 6.3.2): every
// piece is closed by its patches of the surface and its walls alone.
#pragma once

#include <array>

#include "solid/cell_space.h"
#include "solid/skeleton.h"
#include "solid/wall_loops.h"

namespace sherd {

/// What two pieces share, built once: the higher piece shows the triangles as they turn, the lower
/// the other way round.
struct SolidWall {
    uint32_t low = 0, high = 0;
    std::vector<std::array<OutlineVertex, 3>> triangles;
};

struct SolidWalls {
    std::vector<SolidWall> walls;
    std::vector<glm::vec3> hubs;
    /// Per piece: all its walls are there, cross neither the surface nor each other, and hold a
    /// positive volume.
    std::vector<uint8_t> solid;
    /// Pieces are as they were made to fit, not what cells of a pattern are inside.
    bool filled = false;
};

/// piece: per triangle, below pieceCount. space: how patterns divide the inside; null if they do
/// not say it all.
SolidWalls solidWalls(const SplitSurface& surface, const MeshTopology& topology,
                      std::span<const uint32_t> piece, uint32_t pieceCount, const CellSpace* space,
                      HubChoice choice);

}  // namespace sherd
