// SPDX-License-Identifier: MIT
// The three objects of the demo.
#pragma once

#include <string>

#include "crack_pattern.h"
#include "mesh.h"
#include "texture.h"

namespace sherd::samples {

struct SampleObject {
    std::string name;
    Mesh mesh;  ///< stands on y = 0, centred on the y axis
    Image texture;
    double roughness = 0.8;
    CrackPattern cracks;
};

SampleObject makeVase();    ///< 0.36 m high, turned, painted
SampleObject makeWall();    ///< 2 x 1.2 x 0.25 m, dressed blocks in mortar
SampleObject makeColumn();  ///< 1.2 m high, fluted marble

}  // namespace sherd::samples
