// SPDX-License-Identifier: MIT
#include "map/svg_line_style.h"

#include "map/map_limits.h"
#include "map/map_text.h"
#include "map/svg_names.h"

namespace sherd {

namespace {

/// Reads data-strength and the like; what cannot be read leaves the inherited value.
void enterQuantity(const pugi::xml_node& node, const char* name, std::optional<float>& value,
                   std::vector<std::string>& problems) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) return;
    if (const std::optional<float> read = parseQuantity(attribute.value()))
        value = read;
    else
        problems.push_back(std::string(name) + "=\"" + shortened(attribute.value(), 40) +
                           "\" is left out: a number of at least 0 was expected");
}

}  // namespace

void SvgLineStyle::enter(const pugi::xml_node& node, const SvgStyle& style,
                         std::vector<std::string>& problems) {
    const std::string range = "a level from 1 to " + std::to_string(kMaxMapLevel);
    own_.reset();
    std::optional<uint32_t> said = namedLevel(node);
    if (said == 0U) {
        problems.push_back("its name gives no level: " + range + " was expected");
        said.reset();
    }
    if (const pugi::xml_attribute attribute = node.attribute("data-level")) {
        const uint32_t level = parseSmallNumber(attribute.value()).value_or(0);
        if (level >= 1 && level <= kMaxMapLevel)
            said = own_ = level;
        else
            problems.push_back("data-level=\"" + shortened(attribute.value(), 40) +
                               "\" is left out: " + range + " was expected");
    }
    if (said) {
        level_ = *said;
        levelSaid_ = true;
    }
    enterQuantity(node, "data-strength", properties_.strength, problems);
    enterQuantity(node, "data-toughness", properties_.toughness, problems);
    enterStroke(style);
}

void SvgLineStyle::enterStroke(const SvgStyle& style) {
    if (const std::string& color = style[SvgProperty::color]; !color.empty())
        if (const std::optional<SvgColor> parsed = parseSvgColor(color)) color_ = *parsed;
    const std::string stroke = lowered(style[SvgProperty::stroke]);
    if (stroke.empty() || stroke == "inherit") return;
    strokeIsColor_ = stroke == "currentcolor";
    stroke_ = parseSvgColor(stroke);
}

std::optional<uint32_t> SvgLineStyle::layerLevel() const {
    return levelSaid_ ? std::optional(level_) : std::nullopt;
}

uint32_t SvgLineStyle::level(const ColorLevels& colors) const {
    if (own_) return *own_;
    const std::optional<SvgColor> color = stroke();
    return (color ? colors.levelOf(*color) : std::nullopt).value_or(level_);
}

std::optional<SvgColor> SvgLineStyle::idleColor(const ColorLevels& colors) const {
    const std::optional<SvgColor> color = stroke();
    const bool idle = !colors.empty() && color && !levelSaid_ && !colors.levelOf(*color);
    return idle ? color : std::nullopt;
}

}  // namespace sherd
