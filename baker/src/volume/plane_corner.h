// SPDX-License-Identifier: MIT
// Corners of convex cells: where a cell's function equals three others. Like `perturbed_signs.h`,
// in space instead of on a triangle.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "volume/cell_family.h"

namespace sherd {

/// What bounds cell i: f_l - f_i, positive inside, or one of the sides of the box around the mesh.
struct BoundingPlane {
    /// Numbers from here on are sides of the box, which are never perturbed.
    static constexpr uint32_t kBox = 0xFFFFFF00U;
    LinearFunction function;  ///< slopes at most 2^29, offset 2^57
    uint32_t index = 0;       ///< l
    bool isBox() const { return index >= kBox; }
};

/// Sign of plane l at the corner of three planes of cell i; never 0.
int signAtPlaneCorner(const std::array<const BoundingPlane*, 3>& corner, const BoundingPlane& l,
                      uint32_t i);

/// The corner, off by less than 2^-25 of a step per axis if it lies within 2^26 steps.
glm::dvec3 planeCorner(const std::array<const BoundingPlane*, 3>& corner);

}  // namespace sherd
