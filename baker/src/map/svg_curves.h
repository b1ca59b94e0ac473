// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "map/svg_transform.h"

namespace sherd {

/// One piece of an outline, from where the one before it ended.
struct CurvePiece {
    enum class Kind { line, cubic, arc };
    Kind kind = Kind::line;
    glm::dvec2 to{0.0};
    glm::dvec2 control1{0.0}, control2{0.0};  ///< cubic
    /// arc: centre + cos(t) axisU + sin(t) axisV, t from `start` over `sweep` radians
    glm::dvec2 centre{0.0}, axisU{0.0}, axisV{0.0};
    double start = 0, sweep = 0;
};

struct Outline {
    glm::dvec2 start{0.0};
    std::vector<CurvePiece> pieces;
    bool closed = false;
};

/// An SVG arc's end points, radii and flags, as `A` takes them.
struct ArcArguments {
    double rx = 0, ry = 0;
    double rotation = 0;  ///< degrees
    bool large = false, sweep = false;
};

CurvePiece linePiece(glm::dvec2 to);
CurvePiece cubicPiece(glm::dvec2 control1, glm::dvec2 control2, glm::dvec2 to);
CurvePiece quadraticPiece(glm::dvec2 from, glm::dvec2 control, glm::dvec2 to);
/// A line if a radius is 0; radii too small for the distance grow until they reach.
CurvePiece arcPiece(glm::dvec2 from, const ArcArguments& arc, glm::dvec2 to);

/// The outline's points after `transform`, no further than `tolerance` from the curve. Nothing if
/// they would be more than `limit`.
std::optional<std::vector<glm::dvec2>> flatten(const Outline& outline, const Affine& transform,
                                               double tolerance, size_t limit);

}  // namespace sherd
