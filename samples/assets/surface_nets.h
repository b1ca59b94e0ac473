// SPDX-License-Identifier: MIT
// The surface of a shape function as triangles.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesh.h"
#include "signed_distance.h"

namespace sherd::samples {

/// A grid that may be bent to follow the shape: closer planes give smaller triangles.
struct BentGrid {
    std::array<std::vector<double>, 3> planes;  ///< along each axis, ascending
    /// Where a place of the grid lies in space, metres; one-to-one, not mirrored.
    std::function<glm::dvec3(const glm::dvec3&)> bend;
};

/// A closed surface; the whole shape must lie within the grid. Where cells are too large for the
/// shape an edge may be used more than twice, which isClosedManifold tells. UVs and normals are
/// left out.
Mesh meshShape(const ShapeFunction& shape, const BentGrid& grid);

}  // namespace sherd::samples
