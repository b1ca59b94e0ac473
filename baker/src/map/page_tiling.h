// SPDX-License-Identifier: MIT
// The drawing outside its page, as a texture sampler would show it.
#pragma once

#include <cstdint>
#include <vector>

#include "sherd/baker/fracture_map.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// The tiles that texture coordinates reach into: the page itself is tile 0.
struct TileRange {
    int firstU = 0, lastU = 0, firstV = 0, lastV = 0;
    bool onlyPage() const { return firstU == 0 && lastU == 0 && firstV == 0 && lastV == 0; }
};

struct TiledLines {
    std::vector<FractureMap::Line> lines;
    std::vector<uint32_t> lineOf;  ///< per line: the one drawn
};

/// repeat: every tile shows the whole drawing, what sticks out of the page included. mirror: every
/// other one in reverse. clamp: what meets the page's edge goes on straight outwards, what lies
/// outside is left out. Copies are exact: points are brought to the grid before they are moved.
TiledLines tileLines(const std::vector<FractureMap::Line>& lines, Wrap wrapU, Wrap wrapV,
                     const TileRange& range);

}  // namespace sherd
