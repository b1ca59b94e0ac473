// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "map/planar_map.h"
#include "surface/map_index.h"

namespace sherd {

/// A dangling end and where it was led to.
struct ClosedGap {
    glm::dvec2 from, to;
};

/// The nearest place of another line within `reach` of a node that `edge` alone ends at; of its own
/// line only ahead of it.
std::optional<glm::dvec2> lineNear(const PlanarMap& map, MapIndex& index, uint32_t node,
                                   uint32_t edge, double reach);

/// Leads every dangling end of the drawing on to the nearest place of a line within `reach` (UV
/// units); its own line only ahead of it. The line that is met gets a corner there. Lines are
/// changed and added at the end; `lineOf` (per added line): the one it continues.
Result<std::vector<ClosedGap>> closeGaps(FractureMap& map, double reach,
                                         std::vector<uint32_t>& lineOf);

}  // namespace sherd
