// SPDX-License-Identifier: MIT
#include "map/svg_names.h"

#include <algorithm>
#include <cctype>

#include "map/map_limits.h"
#include "map/svg_css.h"

namespace sherd {

namespace {

bool startsWith(std::string_view text, std::string_view start) {
    return text.substr(0, start.size()) == start;
}

}  // namespace

std::optional<uint32_t> levelOfName(std::string_view name) {
    constexpr std::string_view kWord = "level";
    if (name.size() <= kWord.size()) return std::nullopt;
    for (size_t i = 0; i < kWord.size(); ++i)
        if (std::tolower(static_cast<unsigned char>(name[i])) != kWord[i]) return std::nullopt;
    size_t i = kWord.size();
    while (i < name.size() && (name[i] == ' ' || name[i] == '_' || name[i] == '-')) ++i;
    if (i == name.size() || name.size() - i > 3) return std::nullopt;
    uint32_t level = 0;
    for (; i < name.size(); ++i) {
        if (name[i] < '0' || name[i] > '9') return std::nullopt;
        level = 10 * level + static_cast<uint32_t>(name[i] - '0');
    }
    return level >= 1 && level <= kMaxMapLevel ? std::optional(level) : std::nullopt;
}

std::optional<uint32_t> namedLevel(const pugi::xml_node& node) {
    if (const std::optional<uint32_t> level = levelOfName(svgAttribute(node, "label")))
        return level;
    return levelOfName(node.attribute("id").value());
}

std::string_view svgAttribute(const pugi::xml_node& node, std::string_view local) {
    for (const pugi::xml_attribute& attribute : node.attributes())
        if (localName(attribute.name()) == local) return attribute.value();
    return {};
}

bool isSvgGuide(const pugi::xml_node& node) {
    return startsWith(node.name(), "sherd:") || node.attribute("data-sherd-guide") ||
           startsWith(node.attribute("id").value(), "sherd-guide") ||
           startsWith(svgAttribute(node, "label"), "sherd guide");
}

bool isReportedSvgElement(std::string_view name) {
    constexpr std::string_view kNames[] = {
        "text",   "image",   "defs",   "clipPath",      "mask",           "symbol",
        "marker", "pattern", "filter", "foreignObject", "linearGradient", "radialGradient"};
    return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

bool isSvgGroup(std::string_view name) {
    return name == "g" || name == "a" || name == "switch";
}

bool isForeignSvgElement(std::string_view fullName) {
    return fullName != localName(fullName) && !startsWith(fullName, "svg:");
}

}  // namespace sherd
