// SPDX-License-Identifier: MIT
#include "map/svg_names.h"

#include <algorithm>

#include "map/level_word.h"
#include "map/map_text.h"
#include "map/svg_css.h"

namespace sherd {

namespace {

void appendUtf8(std::string& out, uint32_t code) {
    const auto byte = [&](uint32_t value) { out += static_cast<char>(value); };
    if (code < 0x80) return byte(code);
    if (code < 0x800) {
        byte(0xC0U | code >> 6U);
    } else if (code < 0x10000) {
        byte(0xE0U | code >> 12U);
        byte(0x80U | (code >> 6U & 0x3FU));
    } else {
        byte(0xF0U | code >> 18U);
        byte(0x80U | (code >> 12U & 0x3FU));
        byte(0x80U | (code >> 6U & 0x3FU));
    }
    byte(0x80U | (code & 0x3FU));
}

struct Escape {
    size_t length = 0;  ///< 0: there is none
    uint32_t code = 0;
};

/// "_x0020_" at the start of `text`.
Escape escapeAt(std::string_view text) {
    constexpr size_t kMostDigits = 6;
    if (!startsWith(text, "_x")) return {};
    Escape escape;
    size_t i = 2;
    for (; i < text.size() && i < 2 + kMostDigits && text[i] != '_'; ++i) {
        const char lower = lowerChar(text[i]);
        const bool letter = lower >= 'a' && lower <= 'f';
        if (!isDigitChar(lower) && !letter) return {};
        escape.code =
            16 * escape.code + static_cast<uint32_t>(letter ? lower - 'a' + 10 : lower - '0');
    }
    if (i == 2 || i == text.size() || text[i] != '_') return {};
    if (escape.code == 0 || escape.code > 0x10FFFF ||
        (escape.code >= 0xD800 && escape.code < 0xE000))
        return {};
    escape.length = i + 1;
    return escape;
}

/// Editors that escape write a space as "_" (Illustrator) or as "_x0020_" (CorelDRAW), and a true
/// underscore as "_x5F_": in an id with escapes, an underscore that is left is a space.
std::string unescaped(std::string_view id) {
    std::string out;
    bool escapes = false;
    for (size_t i = 0; i < id.size();) {
        const Escape escape = escapeAt(id.substr(i));
        escapes = escapes || escape.length > 0;
        if (escape.length > 0)
            appendUtf8(out, escape.code);
        else
            out += id[i] == '_' ? '\0' : id[i];
        i += std::max<size_t>(escape.length, 1);
    }
    std::replace(out.begin(), out.end(), '\0', escapes ? ' ' : '_');
    return out;
}

/// The name an editor keeps beside an id that it made of it: serif:id or data-name.
std::string_view trueName(const pugi::xml_node& node) {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
        const std::string_view name = attribute.name();
        if (name == "data-name" || (name != "id" && name != "xml:id" && localName(name) == "id"))
            return attribute.value();
    }
    return {};
}

}  // namespace

std::optional<uint32_t> levelOfName(std::string_view name) {
    const std::optional<LevelWord> word = findLevelWord(name, 0, " _-:#.");
    return word ? std::optional(word->level) : std::nullopt;
}

std::string svgObjectName(const pugi::xml_node& node) {
    for (const std::string_view name : {svgAttribute(node, "label"), trueName(node)})
        if (!name.empty()) return std::string(name);
    return unescaped(node.attribute("id").value());
}

std::optional<uint32_t> namedLevel(const pugi::xml_node& node) {
    if (const std::optional<uint32_t> level = levelOfName(svgAttribute(node, "label")))
        return level;
    // An id made of another name says nothing of its own: "level1" is the first copy of "level".
    if (const std::string_view name = trueName(node); !name.empty()) return levelOfName(name);
    return levelOfName(unescaped(node.attribute("id").value()));
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
