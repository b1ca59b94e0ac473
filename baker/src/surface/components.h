// SPDX-License-Identifier: MIT
// Thesis step 5's end (Casella 2013, 4.7): fracture components by flood fill, level by level.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/line_table.h"
#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

/// The components of every level over the same triangles. Level k (1-based) is bounded by the lines
/// of levels 1 to k, so components nest. Level 0 is the whole object.
struct Components {
    uint32_t levels = 0;
    uint32_t parts = 0;          ///< connected parts of the uncut surface
    std::vector<uint32_t> leaf;  ///< per triangle: its component at the deepest level
    uint32_t leafCount = 0;      ///< leaves are numbered by their first triangle
    std::vector<std::vector<uint32_t>> ofLeaf;  ///< [k - 1][leaf]: the component at level k
    std::vector<uint32_t> count;                ///< [k - 1]

    uint32_t at(uint32_t level, uint32_t leafIndex) const {
        return level == 0 ? 0 : ofLeaf[level - 1][leafIndex];
    }
    /// The first level at which two leaves are apart; levels + 1 if they never are.
    uint32_t separatedFrom(uint32_t leafA, uint32_t leafB) const;
};

Components floodFill(const SplitSurface& surface, const MeshTopology& topology,
                     const LineTable& lines, uint32_t levels);

}  // namespace sherd
