// SPDX-License-Identifier: MIT
// A uniform grid over the map's edges: which of them may touch a box in UV.
#pragma once

#include <cstdint>
#include <vector>

#include "map/planar_map.h"

namespace sherd {

class MapIndex {
  public:
    explicit MapIndex(const PlanarMap& map);

    /// Indices of map edges whose bounding box meets [low, high], ascending, each once.
    void query(GridPoint low, GridPoint high, std::vector<uint32_t>& result) const;

  private:
    struct Box {
        GridPoint low, high;
    };
    uint32_t column(int64_t u) const;
    uint32_t row(int64_t v) const;

    std::vector<Box> boxes_;  ///< per edge, rounded outwards
    GridPoint origin_{};
    int64_t cell_ = 1;  ///< grid units
    uint32_t columns_ = 1, rows_ = 1;
    std::vector<uint32_t> start_;  ///< per cell, into edges_
    std::vector<uint32_t> edges_;
};

}  // namespace sherd
