// SPDX-License-Identifier: MIT
// What an SVG element is called, and what that makes of it.
//
// Editors write the name that artists see in attributes of their own, and mangle it into the id:
//   Inkscape     inkscape:label="level 2" id="layer1"    (the id is independent)
//   Illustrator  data-name="level 2" id="level_2", a second one id="level_2-2"; without data-name
//                where the id says it all; older versions id="level_2_1_", and _x3A_ for a colon
//   CorelDRAW    id="level_x0020_2"
//   Affinity     serif:id="level 2" id="level-2", a second one id="level-21"
//   Figma        id="level 2", a second one id="level 2_2"
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace sherd {

/// The number after the word "level" anywhere in the name: "level 2", "Level_2", "cracks level-2",
/// "level2_fine", "level 2 copy". Nothing without such a word; 0 if the number is no level (from 1
/// to kMaxMapLevel).
std::optional<uint32_t> levelOfName(std::string_view name);

/// The name that the artist sees: what the editor keeps for itself, else the id with _xHHHH_
/// escapes undone.
std::string svgObjectName(const pugi::xml_node& node);

/// The level an element's name gives, as levelOfName.
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
