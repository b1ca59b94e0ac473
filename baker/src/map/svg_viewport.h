// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <pugixml.hpp>

#include "map/svg_shapes.h"
#include "map/svg_transform.h"

namespace sherd {

/// Where an element's coordinates are.
struct SvgFrame {
    Affine transform;  ///< to UV
    SvgViewport viewport;
};

/// The outermost svg's frame: its viewBox, or its width and height, span UV [0, 1]^2. Nothing if it
/// says neither.
std::optional<SvgFrame> rootSvgFrame(const pugi::xml_node& root);

/// Enters a nested svg, or a symbol in use, of this size unless it says another. `placed`: its x
/// and y count.
void enterSvgViewport(const pugi::xml_node& node, SvgViewport size, bool placed, SvgFrame& frame);

}  // namespace sherd
