// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

namespace sherd {

/// x' = a x + c y + e, y' = b x + d y + f: SVG's matrix(a b c d e f).
struct Affine {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

    glm::dvec2 direction(glm::dvec2 p) const { return {a * p.x + c * p.y, b * p.x + d * p.y}; }
    glm::dvec2 point(glm::dvec2 p) const { return direction(p) + glm::dvec2(e, f); }
};

/// First `inner`, then `outer`.
Affine operator*(const Affine& outer, const Affine& inner);

/// A list of matrix, translate, scale, rotate, skewX and skewY; nothing if it is misspelt.
std::optional<Affine> parseSvgTransform(std::string_view text);

/// A length in user units; percentages are of `whole`. Nothing if it is no length.
std::optional<double> parseSvgLength(std::string_view text, double whole);

struct SvgViewBox {
    double x = 0, y = 0, width = 0, height = 0;
};
/// Nothing if it is not four numbers with a positive size.
std::optional<SvgViewBox> parseSvgViewBox(std::string_view text);

/// Maps a viewBox onto the viewport at 0, 0 as `preserveAspectRatio` says.
Affine fitSvgViewBox(const SvgViewBox& box, double width, double height, std::string_view aspect);

}  // namespace sherd
