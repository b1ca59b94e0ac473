// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/baker/volume_cut.h"
#include "volume/cell_family.h"
#include "volume/cut_grid.h"

namespace sherd {

struct PieceCells {
    CellFunctions functions;
    std::vector<uint32_t> groups;  ///< per cell; those of one number are one piece; empty: each is

    /// How many there would be, were all cells filled.
    uint32_t pieces() const;
    /// What piece a cell is part of.
    uint32_t groupOf(uint32_t cell) const { return groups.empty() ? cell : groups[cell]; }
};

/// The cells that a cut makes of one piece, a closed mesh. Places of the cut are in the mesh's
/// frame here. The same seed gives the same cells. Errors: badArgument, limitExceeded.
Result<PieceCells> pieceCells(const VolumeCut& cut, uint64_t seed,
                              std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles,
                              const CutGrid& grid);

}  // namespace sherd
