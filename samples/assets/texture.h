// SPDX-License-Identifier: MIT
// Textures painted by code: a colour for each texel's place on the surface.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh.h"

namespace sherd::samples {

/// Square, 8-bit RGB (sRGB), rows from the top.
struct Image {
    uint32_t size = 0;
    std::vector<uint8_t> pixels;
};

/// What a painter knows about the texel's place.
struct SurfacePoint {
    glm::dvec3 position{0.0};  ///< metres
    glm::dvec3 normal{0.0};
    glm::dvec2 uv{0.0};
};

/// The colour at a place: sRGB, 0 to 1.
using Painter = std::function<glm::dvec3(const SurfacePoint&)>;

/// Paints every texel under a triangle, then bleeds the charts' rims into the gutter, so that
/// filtering finds no background colour at a seam.
Image paintTexture(const Mesh& mesh, uint32_t size, const Painter& painter);

std::vector<uint8_t> encodePng(const Image& image);

/// 0 below `low`, 1 above `high`, smooth between.
double smoothStep(double low, double high, double x);

/// 1 inside |x| < half, 0 outside, with a rim `soft` wide.
double stripe(double x, double half, double soft);

}  // namespace sherd::samples
