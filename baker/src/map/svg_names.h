// SPDX-License-Identifier: MIT
// What an SVG element is called, and what that makes of it.
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

namespace sherd {

/// "level 2", "Level_2", "level-2", "level2": the number, if it is from 1 to kMaxMapLevel.
std::optional<uint32_t> levelOfName(std::string_view name);

/// The level an element's label or id names.
std::optional<uint32_t> namedLevel(const pugi::xml_node& node);

/// An attribute by its local name, whatever the prefix: href and xlink:href, inkscape:label.
std::string_view svgAttribute(const pugi::xml_node& node, std::string_view local);

/// Belongs to the layer that `sherd-bake layout` draws for orientation.
bool isSvgGuide(const pugi::xml_node& node);

/// Elements that never draw lines themselves; worth a word when they are there.
bool isReportedSvgElement(std::string_view name);

bool isSvgGroup(std::string_view name);

/// An element of an editor's own, which draws nothing.
bool isForeignSvgElement(std::string_view fullName);

}  // namespace sherd
