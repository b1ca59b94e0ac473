// SPDX-License-Identifier: MIT
#include "map/svg_css.h"

#include <algorithm>

namespace sherd {

namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    return text;
}

/// Calls `visit` for each part of `text` between separators.
template <class Visit>
void forEachPart(std::string_view text, char separator, const Visit& visit) {
    while (!text.empty()) {
        const size_t end = std::min(text.find(separator), text.size());
        visit(trim(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

std::string withoutComments(std::string_view css) {
    std::string out;
    for (;;) {
        const size_t begin = css.find("/*");
        out += css.substr(0, begin);
        if (begin == std::string_view::npos) return out;
        const size_t end = css.find("*/", begin + 2);
        if (end == std::string_view::npos) return out;
        css.remove_prefix(end + 2);
    }
}

/// Where the block that opens at `open` ends: the position of its closing brace.
size_t blockEnd(std::string_view css, size_t open) {
    size_t depth = 0;
    for (size_t i = open; i < css.size(); ++i) {
        if (css[i] == '{') ++depth;
        if (css[i] == '}' && --depth == 0) return i;
    }
    return css.size();
}

/// The last value a declaration list gives to `property`, without "!important".
std::string declared(std::string_view declarations, std::string_view property) {
    std::string value;
    forEachPart(declarations, ';', [&](std::string_view part) {
        const size_t colon = part.find(':');
        if (colon == std::string_view::npos || trim(part.substr(0, colon)) != property) return;
        std::string_view found = part.substr(colon + 1);
        value = trim(found.substr(0, found.find('!')));
    });
    return value;
}

bool hasClass(std::string_view list, std::string_view name) {
    while (!(list = trim(list)).empty()) {
        size_t end = 0;
        while (end < list.size() && !isSpace(list[end])) ++end;
        if (list.substr(0, end) == name) return true;
        list.remove_prefix(end);
    }
    return false;
}

}  // namespace

std::string_view localName(std::string_view name) {
    const size_t colon = name.rfind(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

void SvgStyleSheet::add(std::string_view css) {
    const std::string plain = withoutComments(css);
    std::string_view rest = plain;
    while (!(rest = trim(rest)).empty()) {
        const size_t open = rest.find('{');
        const size_t semicolon = rest.find(';');
        if (rest.front() == '@' && semicolon < open) {  // @import and the like
            rest.remove_prefix(semicolon + 1);
            continue;
        }
        if (open == std::string_view::npos) return;
        const size_t close = blockEnd(rest, open);
        if (rest.front() != '@')
            addRule(rest.substr(0, open), rest.substr(open + 1, close - open - 1));
        rest.remove_prefix(std::min(close + 1, rest.size()));
    }
}

void SvgStyleSheet::addRule(std::string_view selectors, std::string_view declarations) {
    forEachPart(selectors, ',', [&](std::string_view text) {
        if (std::optional<Selector> selector = parseSelector(text))
            rules_.push_back({std::move(*selector), std::string(declarations)});
    });
}

std::optional<SvgStyleSheet::Selector> SvgStyleSheet::parseSelector(std::string_view text) {
    constexpr std::string_view kMarks = ".#";
    if (text.empty() || text.find_first_of(" \t\r\n>+~[]:()\\") != std::string_view::npos)
        return std::nullopt;
    Selector selector;
    while (!text.empty()) {
        const bool marked = kMarks.find(text.front()) != std::string_view::npos;
        const size_t end = std::min(text.find_first_of(kMarks, 1), text.size());
        const std::string name(text.substr(marked ? 1 : 0, end - (marked ? 1 : 0)));
        if (name.empty()) return std::nullopt;
        if (text.front() == '.')
            selector.classes.push_back(name);
        else if (text.front() == '#')
            selector.id = name;
        else if (name != "*")
            selector.type = name;
        text.remove_prefix(end);
    }
    return selector;
}

bool SvgStyleSheet::matches(const Selector& selector, const pugi::xml_node& node) {
    if (!selector.type.empty() && selector.type != localName(node.name())) return false;
    if (!selector.id.empty() && selector.id != node.attribute("id").value()) return false;
    const std::string_view classes = node.attribute("class").value();
    return std::all_of(selector.classes.begin(), selector.classes.end(),
                       [&](const std::string& name) { return hasClass(classes, name); });
}

std::string SvgStyleSheet::property(const pugi::xml_node& node, const char* property) const {
    std::string value = declared(node.attribute("style").value(), property);
    if (!value.empty()) return value;
    size_t strongest = 0;
    for (const Rule& rule : rules_) {
        const size_t strength = rule.selector.specificity();
        if (strength < strongest || !matches(rule.selector, node)) continue;
        const std::string found = declared(rule.declarations, property);
        if (found.empty()) continue;
        value = found;
        strongest = strength;
    }
    if (!value.empty()) return value;
    return std::string(trim(node.attribute(property).value()));
}

}  // namespace sherd
