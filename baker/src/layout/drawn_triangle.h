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

/// The triangles of a mesh as they are drawn.
class DrawnMesh {
  public:
    explicit DrawnMesh(const SurfaceMesh& mesh);

    /// Zero for a mesh without texture coordinates.
    size_t size() const { return uv_ == nullptr ? 0 : mesh_.corners.size(); }
    /// With points that are no numbers where the mesh has such.
    DrawnTriangle operator[](size_t triangle) const;
    /// The corners in the frame lines are cut in: as the texture of their material lies there.
    std::array<glm::dvec2, 3> placed(size_t triangle) const;

  private:
    std::array<glm::vec2, 3> corners(size_t triangle) const;
    TexturePlacement placement(size_t triangle) const;

    const SurfaceMesh& mesh_;
    const Attribute* uv_;
};

}  // namespace sherd
