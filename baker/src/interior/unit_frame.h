// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "geometry/bounds.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// The mesh moved and scaled to a box of size 1 around the origin, by a power of two: input scaled
/// by a power of two gives the same bits here.
struct UnitFrame {
    glm::dvec3 centre{0};
    int exponent = 0;     ///< one unit is 2^exponent metres
    double diagonal = 0;  ///< of the bounding box, in units

    UnitFrame() = default;
    explicit UnitFrame(const SurfaceMesh& mesh) {
        const Bounds box = boundsOf(mesh.positions, mesh.triangles);
        if (box.empty()) return;
        const glm::dvec3 size = box.size();
        centre = box.low + size / 2.0;
        std::frexp(std::max({size.x, size.y, size.z}), &exponent);
        diagonal = std::ldexp(glm::length(size), -exponent);
    }
    glm::dvec3 toUnit(const glm::dvec3& p) const {
        return (p - centre) * std::ldexp(1.0, -exponent);
    }
    glm::vec3 toObject(const glm::dvec3& p) const {
        return glm::vec3(centre + p * std::ldexp(1.0, exponent));
    }
};

}  // namespace sherd
