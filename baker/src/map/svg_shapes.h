// SPDX-License-Identifier: MIT
#pragma once

#include <pugixml.hpp>

#include "map/svg_path.h"

namespace sherd {

/// The viewport lengths are measured against.
struct SvgViewport {
    double width = 0, height = 0;
};

/// Whether the element draws lines: path, line, polyline, polygon, rect, circle or ellipse.
bool isSvgShape(std::string_view name);

/// Its outlines in its own coordinates. A size of zero draws nothing and is no problem.
SvgPath svgShape(const pugi::xml_node& node, const SvgViewport& viewport);

/// An attribute as a length; `fallback` if it is absent or no length.
double svgLength(const pugi::xml_node& node, const char* name, double whole, double fallback);

}  // namespace sherd
