// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "sherd/baker/surface_mesh.h"

namespace sherd {

enum class DrawnWhere : uint8_t {
    inPlace,      ///< its centre is on the picture
    anotherTile,  ///< moved onto it from another tile of a repeating or mirrored texture
    beyondEdge,   ///< off the picture, where a clamped texture shows its last pixels only
};

struct DrawnTriangle {
    std::array<glm::vec2, 3> points;
    DrawnWhere where = DrawnWhere::inPlace;
};

/// Where on the picture a triangle of the UV set is drawn: where its texture shows. Triangles that
/// lie on the picture as they are keep their bits.
DrawnTriangle drawnTriangle(const std::array<glm::vec2, 3>& uv, const TexturePlacement& placement);

}  // namespace sherd
