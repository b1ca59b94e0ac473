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

    /// Indices of map edges that may meet [low, high], ascending, each once.
    void query(GridPoint low, GridPoint high, std::vector<uint32_t>& result);

  private:
    struct Box {
        GridPoint low, high;
    };
    template <class Visit>
    void forEachCell(const PlanarMap& map, uint32_t edge, Visit&& visit) const;
    uint32_t column(int64_t u) const;
    uint32_t row(int64_t v) const;

    std::vector<Box> boxes_;  ///< per edge, rounded outwards
    GridPoint origin_{};
    uint32_t shift_ = 0;  ///< a cell is 2^shift_ grid units wide
    uint32_t columns_ = 1, rows_ = 1;
    std::vector<uint32_t> start_;  ///< per cell, into edges_
    std::vector<uint32_t> edges_;
    std::vector<uint32_t> found_;  ///< per edge: the last query it was found in
    uint32_t query_ = 0;
};

}  // namespace sherd
