// SPDX-License-Identifier: MIT
// Labels in a drawing: words about the component they lie on, in a form every editor can write.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "map/svg_viewport.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

/// Where a text is read as a label: in <text>, or as the name of a shape or group.
enum class LabelForm { text, name };

/// Whether it starts with "label:" or holds a "name:", "material:", "density:" or "anchor:"; a text
/// also by "strength:", "toughness:" or a bare "anchor" between semicolons. (A line may be called
/// after its strength or toughness; it stays a line.)
bool readsAsLabel(std::string_view words, LabelForm form);

/// "name: rim; material: glass; toughness: 5; anchor" into `label`. Words that cannot be read are
/// left out and added to `problems`.
void readLabelWords(std::string_view words, FractureMap::Label& label,
                    std::vector<std::string>& problems);

/// Whether an element is a label by its attributes: data-label, data-material, data-density or
/// data-anchor.
bool hasSvgLabelAttributes(const pugi::xml_node& node);

/// Whether a shape or group is a label by its attributes or its name.
bool isSvgLabel(const pugi::xml_node& node);

/// What a shape's or group's name says; without words in it, data-name is the label's name.
void readSvgLabelName(const pugi::xml_node& node, FractureMap::Label& label,
                      std::vector<std::string>& problems);

/// What the attributes say.
void readSvgLabelAttributes(const pugi::xml_node& node, FractureMap::Label& label,
                            std::vector<std::string>& problems);

struct SvgTextContent {
    std::string words;      ///< a line of text per line
    glm::dvec2 place{0.0};  ///< where its first character stands, in its own coordinates
};
SvgTextContent svgTextContent(const pugi::xml_node& text, const SvgViewport& viewport);

}  // namespace sherd
