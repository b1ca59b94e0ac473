// SPDX-License-Identifier: MIT
#include "map/svg_css.h"

#include <algorithm>

#include "map/map_text.h"

namespace sherd {

namespace {

constexpr size_t kMaxRules = 100'000;        ///< that say something of a property read here
constexpr size_t kMaxRuleWork = 10'000'000;  ///< rules compared with elements: some seconds

constexpr std::array<const char*, kSvgPropertyCount> kPropertyNames = {
    "display", "visibility", "opacity", "transform", "stroke", "color"};

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

/// The words of a class attribute, sorted, each once.
std::vector<std::string_view> classesOf(std::string_view list) {
    std::vector<std::string_view> classes;
    while (!(list = trim(list)).empty()) {
        size_t end = 0;
        while (end < list.size() && !isSpaceChar(list[end])) ++end;
        classes.push_back(list.substr(0, end));
        list.remove_prefix(end);
    }
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    return classes;
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
        const size_t open = rest.find_first_of(rest.front() == '@' ? "{;" : "{");
        if (open == std::string_view::npos) return;
        if (rest[open] == ';') {  // @import and the like
            rest.remove_prefix(open + 1);
            continue;
        }
        const size_t close = blockEnd(rest, open);
        if (rest.front() != '@')
            addRule(rest.substr(0, open), rest.substr(open + 1, close - open - 1));
        rest.remove_prefix(std::min(close + 1, rest.size()));
    }
}

/// In a list, the last value of a property holds; "!important" is left out.
std::vector<SvgStyleSheet::Declaration> SvgStyleSheet::parseDeclarations(std::string_view text) {
    std::vector<Declaration> declarations;
    forEachPart(text, ';', [&](std::string_view part) {
        const size_t colon = part.find(':');
        if (colon == std::string_view::npos) return;
        const auto* const name =
            std::find(kPropertyNames.begin(), kPropertyNames.end(), trim(part.substr(0, colon)));
        const std::string_view value = trim(part.substr(colon + 1));
        const std::string_view plain = trim(value.substr(0, value.find('!')));
        if (name == kPropertyNames.end() || plain.empty()) return;
        const auto property = static_cast<SvgProperty>(name - kPropertyNames.begin());
        const auto same =
            std::find_if(declarations.begin(), declarations.end(),
                         [&](const Declaration& each) { return each.property == property; });
        if (same == declarations.end())
            declarations.push_back({property, std::string(plain)});
        else
            same->value = plain;
    });
    return declarations;
}

void SvgStyleSheet::addRule(std::string_view selectors, std::string_view declarations) {
    const std::vector<Declaration> parsed = parseDeclarations(declarations);
    if (parsed.empty()) return;
    forEachPart(selectors, ',', [&](std::string_view text) {
        std::optional<Selector> selector = parseSelector(text);
        if (!selector) return;
        if (rules_.size() >= kMaxRules) {
            overflowed_ = true;
            return;
        }
        rulesOf_[keyOf(*selector)].push_back(rules_.size());
        rules_.push_back({std::move(*selector), parsed});
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

/// What an element must have for the rule to be looked at: "#id", ".class", "type" or "*".
std::string SvgStyleSheet::keyOf(const Selector& selector) {
    if (!selector.id.empty()) return "#" + selector.id;
    if (!selector.classes.empty()) return "." + selector.classes.front();
    return selector.type.empty() ? "*" : selector.type;
}

/// What selectors ask of an element.
struct SvgStyleSheet::Subject {
    std::string_view type, id;
    std::vector<std::string_view> classes;
};

bool SvgStyleSheet::matches(const Selector& selector, const Subject& subject) {
    if (!selector.type.empty() && selector.type != subject.type) return false;
    if (!selector.id.empty() && selector.id != subject.id) return false;
    return std::all_of(
        selector.classes.begin(), selector.classes.end(), [&](const std::string& name) {
            return std::binary_search(subject.classes.begin(), subject.classes.end(), name);
        });
}

/// The strongest value of each property so far; of equally strong ones the later rule's.
struct SvgStyleSheet::Cascade {
    struct Winner {
        size_t specificity = 0;
        size_t order = 0;
        const std::string* value = nullptr;
    };
    std::array<Winner, kSvgPropertyCount> winners;

    void offer(const Declaration& declaration, size_t specificity, size_t order) {
        Winner& winner = winners[static_cast<size_t>(declaration.property)];
        const bool weaker =
            std::pair(specificity, order) < std::pair(winner.specificity, winner.order);
        if (winner.value == nullptr || !weaker) winner = {specificity, order, &declaration.value};
    }
};

void SvgStyleSheet::tryRules(const std::string& key, const Subject& subject,
                             Cascade& cascade) const {
    const auto found = rulesOf_.find(key);
    if (found == rulesOf_.end()) return;
    for (const size_t r : found->second) {
        work_ += 1 + rules_[r].selector.classes.size();
        if (work_ > kMaxRuleWork) {
            overflowed_ = true;
            return;
        }
        if (!matches(rules_[r].selector, subject)) continue;
        for (const Declaration& declaration : rules_[r].declarations)
            cascade.offer(declaration, rules_[r].selector.specificity(), r);
    }
}

SvgStyle SvgStyleSheet::styleOf(const pugi::xml_node& node) const {
    SvgStyle style;
    for (size_t p = 0; p < kSvgPropertyCount; ++p)
        style[static_cast<SvgProperty>(p)] = trim(node.attribute(kPropertyNames[p]).value());
    if (!rules_.empty()) {
        const Subject subject{localName(node.name()), node.attribute("id").value(),
                              classesOf(node.attribute("class").value())};
        Cascade cascade;
        tryRules("*", subject, cascade);
        tryRules(std::string(subject.type), subject, cascade);
        if (!subject.id.empty()) tryRules("#" + std::string(subject.id), subject, cascade);
        for (const std::string_view name : subject.classes)
            tryRules("." + std::string(name), subject, cascade);
        for (size_t p = 0; p < kSvgPropertyCount; ++p)
            if (cascade.winners[p].value != nullptr)
                style[static_cast<SvgProperty>(p)] = *cascade.winners[p].value;
    }
    for (Declaration& declaration : parseDeclarations(node.attribute("style").value()))
        style[declaration.property] = std::move(declaration.value);
    return style;
}

}  // namespace sherd
