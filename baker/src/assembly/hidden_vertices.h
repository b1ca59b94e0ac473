// SPDX-License-Identifier: MIT
// Vertices of hidden faces: walls are flat, sheets smooth; texture coordinates are projected along
// the main axis of the face, so that texels have an even size.
#pragma once

#include "assembly/geometry.h"

namespace sherd {

class HiddenVertices {
  public:
    HiddenVertices(const AssemblyInput& input, FractureGeometry& out);

    /// The three output vertices of a face. A leaf's sheet is asked for in one go: its vertices are
    /// shared only while no other leaf's sheet comes between.
    std::array<uint32_t, 3> vertices(const HiddenMesh::Face& face);

  private:
    void beginSheet(uint32_t leaf);
    uint32_t newVertex(const glm::vec3& position, const glm::vec3& normal, int axis);

    struct SheetVertex {
        uint32_t leaf = kNone;  ///< whose sheet the rest is about
        glm::dvec3 normal{0.0};
        std::array<uint32_t, 3> ofAxis{kNone, kNone, kNone};  ///< per projection axis
    };
    const AssemblyInput& in_;
    FractureGeometry& out_;
    std::vector<std::vector<uint32_t>> sheetFaces_;  ///< per leaf
    std::vector<SheetVertex> sheet_;                 ///< per hidden position
    uint32_t sheetLeaf_ = kNone;
};

}  // namespace sherd
