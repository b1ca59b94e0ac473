// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "map/svg_css.h"

namespace sherd {

/// What has to be known of a whole drawing before anything is drawn.
struct SvgIndex {
    explicit SvgIndex(const pugi::xml_node& root);

    /// The element that "#crack3" names, or a null node.
    pugi::xml_node find(std::string_view href) const;

    std::map<std::string, pugi::xml_node> ids;
    SvgStyleSheet styles;
};

/// Shapes in the guide layer that the layout did not put there: drawn in the wrong layer.
size_t countStrayShapes(const pugi::xml_node& guide);

}  // namespace sherd
