// SPDX-License-Identifier: MIT
// The objects of the demo.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "crack_pattern.h"
#include "mesh.h"
#include "texture.h"

namespace sherd::samples {

/// Texels along a side of every sample's texture.
inline constexpr uint32_t kSampleTexture = 1024;

/// What the object is made of, for the recipe.
struct Stuff {
    glm::dvec3 color{0.5};  ///< linear, of a broken face
    double density = 2400;  ///< kg/m^3
};

struct SampleObject {
    std::string name;
    Mesh mesh;  ///< stands on y = 0, centred on the y axis
    Image texture;
    double roughness = 0.8;
    Stuff stuff;
    CrackPattern cracks;
};

SampleObject makeVase();    ///< 0.36 m high, turned, painted
SampleObject makeWall();    ///< 2 x 1.2 x 0.25 m, dressed blocks in mortar
SampleObject makeColumn();  ///< 1.2 m high, fluted marble
SampleObject makeFigure();  ///< 1 m high, a limestone statue

}  // namespace sherd::samples
