// SPDX-License-Identifier: MIT
// Texture coordinates of hidden faces with an even size of texels: surfaces are divided into charts
// that lie near a plane, and each is projected onto its own. After the charts of Levy et al., Least
// Squares Conformal Maps for Automatic Texture Atlas Generation (2002), but with planes for maps:
// hidden faces have tiling textures, so charts may overlap in the texture and need no packing.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "appearance/hidden_mesh.h"

namespace sherd {

/// How positions become texture coordinates in one chart. The picture stands upright: its up is the
/// object's +y, or -z for faces that look up and +z for those that look down.
struct ChartFrame {
    glm::dvec3 normal{0.0};  ///< unit: of the chart's plane
    glm::dvec3 right{0.0};   ///< unit, in the plane; u grows along it
    glm::dvec3 up{0.0};      ///< unit, in the plane; v falls along it
    double tilesPerMetre = 1;
    glm::dvec2 origin{0.0};  ///< whole tiles taken off

    glm::dvec2 uv(const glm::dvec3& p) const;
};

struct TextureCharts {
    std::vector<uint32_t> ofFace;
    std::vector<ChartFrame> frames;
};

/// `opposite` as hiddenOpposites gives it.
TextureCharts textureCharts(const HiddenMesh& mesh, std::span<const uint32_t> opposite,
                            const FaceShapes& shapes, double metresPerTile);

}  // namespace sherd
