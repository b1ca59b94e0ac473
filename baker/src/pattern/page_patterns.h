// SPDX-License-Identifier: MIT
// Patterns that are drawn on a page and then projected: grids, bricks, and the spokes and rings of
// broken glass.
#pragma once

#include <functional>
#include <glm/vec2.hpp>

#include "sherd/baker/fracture_map.h"
#include "sherd/baker/pattern.h"

namespace sherd {

struct PagePattern {
    FractureMap map;  ///< lines of level 1
    /// The cell at a place of the page.
    std::function<uint32_t(const glm::dvec2& uv)> cellAt;
    uint32_t cells = 0;
};

/// Columns and rows over [0, 1]^2. Bricks: every other row is shifted by half a column, so it has a
/// cell more.
PagePattern drawGrid(const Pattern& pattern);

/// Spokes and rings around (0, 0); the outermost ring is endless. Rings lie closer together near
/// the middle, as in struck glass. `reach`: how far the object extends, at most 4.
PagePattern drawRadial(const Pattern& pattern, double reach);

}  // namespace sherd
