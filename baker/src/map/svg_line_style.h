// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "map/svg_color.h"
#include "map/svg_css.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

/// What an element and those around it say of its lines.
class SvgLineStyle {
  public:
    explicit SvgLineStyle(uint32_t level = 1) : level_(level) {}

    /// Takes in a node inside: its name, its data-level, -strength and -toughness, its stroke.
    void enter(const pugi::xml_node& node, const SvgStyle& style,
               std::vector<std::string>& problems);

    /// The level that the layers around give, if one does.
    std::optional<uint32_t> layerLevel() const;
    /// The element's own data-level, else its stroke colour's, else its layer's level.
    uint32_t level(const ColorLevels& colors) const;
    /// The stroke colour, if it has one that chooses no level where no layer does either.
    std::optional<SvgColor> idleColor(const ColorLevels& colors) const;
    const LineProperties& properties() const { return properties_; }

  private:
    void enterStroke(const SvgStyle& style);
    std::optional<SvgColor> stroke() const { return strokeIsColor_ ? color_ : stroke_; }

    uint32_t level_;
    bool levelSaid_ = false;
    std::optional<uint32_t> own_;
    std::optional<SvgColor> stroke_;
    bool strokeIsColor_ = false;  ///< currentColor
    SvgColor color_;
    LineProperties properties_;
};

}  // namespace sherd
