// SPDX-License-Identifier: MIT
// Vertices of hidden faces: walls are flat, sheets smooth; texture coordinates are projected along
// the main axis of the face, so that texels have an even size.
#pragma once

#include <map>
#include <tuple>

#include "assembly/geometry.h"

namespace sherd {

class HiddenVertices {
  public:
    HiddenVertices(const AssemblyInput& input, FractureGeometry& out);

    /// The three output vertices of a face.
    std::array<uint32_t, 3> vertices(const HiddenFace& face);

  private:
    glm::vec3 position(CornerRef ref) const;
    uint32_t splitVertex(CornerRef ref) const;
    uint32_t newVertex(const glm::vec3& position, const glm::vec3& normal, int axis);

    const AssemblyInput& in_;
    FractureGeometry& out_;
    std::map<std::tuple<uint32_t, uint32_t>, glm::dvec3> sheetNormals_;      ///< leaf, split vertex
    std::map<std::tuple<uint32_t, uint32_t, int>, uint32_t> sheetVertices_;  ///< and the axis
};

}  // namespace sherd
