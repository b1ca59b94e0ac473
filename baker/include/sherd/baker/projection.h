// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "sherd/formats/result.h"

namespace sherd {

/// How the page a drawing is made on, [0, 1]^2 with v down, comes to lie on the object.
struct Projection {
    enum class Kind : uint8_t {
        uv,           ///< by the mesh's texture coordinates
        planar,       ///< straight through the object, front and back alike
        cylindrical,  ///< wrapped once around an axis
        box           ///< onto the six sides of the bounding box, each showing the whole page
    };
    Kind kind = Kind::uv;
    /// planar: the direction looked along; cylindrical: the axis. Zero: chosen by the object's
    /// extent: looked at its largest side, wrapped around its longest.
    glm::dvec3 axis{0.0};
    friend bool operator==(const Projection&, const Projection&) = default;
};

/// "uv", "box", "planar", "planar:x|y|z|X,Y,Z", "cylindrical[:AXIS]". Error badArgument says what
/// is known.
Result<Projection> parseProjection(std::string_view text);

/// "x", "-y", "z" or "X,Y,Z" as a unit vector. Error badArgument.
Result<glm::dvec3> parseAxis(std::string_view text);

}  // namespace sherd
