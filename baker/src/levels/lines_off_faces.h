// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "sherd/baker/fracture_map.h"

namespace sherd {

/// A face of the object that stands upright on the drawing's plane, where it is seen from above as
/// a stretch; the solid is to the left of from -> to.
struct UprightFace {
    glm::dvec2 from{0.0}, to{0.0};
    double area = 0;
};

struct MovedLines {
    uint32_t moved = 0;  ///< stretches of lines
    uint32_t opposed =
        0;  ///< of these, with faces that wanted it otherwise: the larger area decided
};

/// Lines along faces of the object move outwards by `by`, and with them what ends on them: so no
/// flap without a volume owns the object's skin. A face is along a line if it lies within half of
/// `by`.
MovedLines moveOffFaces(std::span<const UprightFace> faces, double by, FractureMap& map);

}  // namespace sherd
