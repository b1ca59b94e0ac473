// SPDX-License-Identifier: MIT
#include "map/svg_labels.h"

#include <array>

#include "map/map_limits.h"
#include "map/map_text.h"
#include "map/svg_css.h"
#include "map/svg_names.h"

namespace sherd {

namespace {

constexpr size_t kMaxWordBytes = 256;    ///< of a name or material
constexpr size_t kMaxLabelBytes = 4096;  ///< of a text that may be a label
constexpr size_t kMaxTextDepth = 32;     ///< tspans within tspans

constexpr std::array<std::string_view, 8> kKeys = {"label",   "name",     "material",  "anchor",
                                                   "density", "strength", "toughness", "level"};
constexpr size_t kNameKeys = 5;  ///< the first of them make a label of a named shape,
constexpr size_t kTextKeys = 7;  ///< and these of a text

/// "key: value"; `key` is empty if the clause has none that is known.
struct Clause {
    std::string_view key, value;
};

Clause clauseOf(std::string_view text) {
    const size_t colon = text.find(':');
    if (colon != std::string_view::npos) {
        const std::string word = lowered(trim(text.substr(0, colon)));
        for (const std::string_view key : kKeys)
            if (word == key) return {key, trim(text.substr(colon + 1))};
    }
    return {{}, trim(text)};
}

bool isAnchorWord(std::string_view text) {
    return lowered(trim(text)) == "anchor";
}

/// Calls visit(clause, startsLine) for each clause.
template <class Visit>
void forEachClause(std::string_view words, const Visit& visit) {
    forEachPart(words, '\n', [&](std::string_view line) {
        bool first = true;
        forEachPart(line, ';', [&](std::string_view part) {
            if (!part.empty()) visit(part, first);
            first = false;
        });
    });
}

/// Reads clause by clause.
class LabelWords {
  public:
    LabelWords(FractureMap::Label& label, std::vector<std::string>& problems)
        : label_(label), problems_(problems) {}

    void read(std::string_view part, bool startsLine) {
        Clause clause = clauseOf(part);
        if (clause.key == "label") {
            const Clause inner = clauseOf(clause.value);
            if (!inner.key.empty() && inner.key != "label") return set(inner.key, inner.value);
            if (isAnchorWord(clause.value)) return set("anchor", "");
            return set("name", clause.value);
        }
        if (!clause.key.empty()) return set(clause.key, clause.value);
        if (isAnchorWord(part)) return set("anchor", "");
        if (startsLine && last_ != nullptr) {  // a line broken in the middle of a value
            *last_ += ' ';
            last_->append(part);
            return;
        }
        problems_.push_back("\"" + shortened(part, 40) +
                            "\" is none of name, material, density, strength, toughness, level "
                            "and anchor");
    }

    void set(std::string_view key, std::string_view value) {
        last_ = nullptr;
        if (key == "name") return setText(label_.name, value);
        if (key == "material") return setText(label_.material, value);
        if (key == "anchor") return setAnchor(value);
        if (key == "level") return setLevel(value);
        const std::optional<float> number = parseQuantity(value);
        if (!number || (key == "density" && *number == 0))
            return wrong(key, value,
                         key == "density" ? "a number above 0" : "a number of at least 0");
        (key == "density"    ? label_.density
         : key == "strength" ? label_.strength
                             : label_.toughness) = number;
    }

    /// Names and materials may have grown line by line.
    void finish() {
        for (auto [key, text] :
             {std::pair("name", &label_.name), std::pair("material", &label_.material)}) {
            if (text->size() <= kMaxWordBytes) continue;
            wrong(key, *text, "at most " + std::to_string(kMaxWordBytes) + " bytes");
            text->clear();
        }
    }

  private:
    void wrong(std::string_view key, std::string_view value, const std::string& wanted) {
        std::string problem = std::string(key) + " \"" + shortened(value, 40) + "\" is left out: ";
        problems_.push_back(problem + wanted + " was expected");
    }
    void setText(std::string& target, std::string_view value) {
        target = value;
        last_ = &target;
    }
    void setAnchor(std::string_view value) {
        const std::string word = lowered(value);
        const bool yes = word.empty() || word == "true" || word == "yes" || word == "1" ||
                         word == "anchor" || word == "data-anchor";
        const bool no = word == "false" || word == "no" || word == "0";
        if (!yes && !no) return wrong("anchor", value, "true or false");
        label_.anchor = yes;
    }
    void setLevel(std::string_view value) {
        const std::optional<uint32_t> level = parseSmallNumber(value);
        if (!level || *level > kMaxMapLevel)
            return wrong("level", value, "a level from 0 to " + std::to_string(kMaxMapLevel));
        label_.level = *level;
    }

    FractureMap::Label& label_;
    std::vector<std::string>& problems_;
    std::string* last_ = nullptr;  ///< the value that a further line would continue
};

/// The first of a list of coordinates, or nothing.
std::optional<double> firstLength(const pugi::xml_node& node, const char* name, double whole) {
    const std::string_view list = trim(node.attribute(name).value());
    if (list.empty()) return std::nullopt;
    return parseSvgLength(list.substr(0, list.find_first_of(" ,\t\r\n")), whole);
}

/// Puts a text together from its tspans. Where a tspan stands lower or higher, a new line starts.
class TextCollector {
  public:
    explicit TextCollector(const SvgViewport& viewport) : viewport_(viewport) {}

    void visit(const pugi::xml_node& node, size_t depth) {
        const std::optional<double> x = firstLength(node, "x", viewport_.width);
        const std::optional<double> y = firstLength(node, "y", viewport_.height);
        const double dy = firstLength(node, "dy", viewport_.height).value_or(0);
        const bool begun = !trim(content_.words).empty();
        if (begun && ((y && *y != y_) || dy != 0)) content_.words += '\n';
        if (y) y_ = *y;
        if (!begun && x) content_.place.x = *x;
        if (!begun && y) content_.place.y = *y;
        for (const pugi::xml_node& child : node.children()) {
            if (content_.words.size() > kMaxLabelBytes) return;
            if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
                content_.words += child.value();
            else if (localName(child.name()) == "tspan" && depth < kMaxTextDepth)
                visit(child, depth + 1);
        }
    }
    SvgTextContent take() { return std::move(content_); }

  private:
    SvgViewport viewport_;
    SvgTextContent content_;
    double y_ = 0;
};

}  // namespace

bool readsAsLabel(std::string_view words, LabelForm form) {
    if (words.size() > kMaxLabelBytes) return false;
    const size_t count = form == LabelForm::text ? kTextKeys : kNameKeys;
    bool known = false;
    forEachClause(words, [&](std::string_view part, bool) {
        known = known || (form == LabelForm::text && isAnchorWord(part));
        const std::string_view key = clauseOf(part).key;
        for (size_t k = 0; k < count; ++k) known = known || key == kKeys[k];
    });
    return known;
}

void readLabelWords(std::string_view words, FractureMap::Label& label,
                    std::vector<std::string>& problems) {
    LabelWords reader(label, problems);
    forEachClause(words,
                  [&](std::string_view part, bool startsLine) { reader.read(part, startsLine); });
    reader.finish();
}

bool hasSvgLabelAttributes(const pugi::xml_node& node) {
    for (const char* name : {"data-label", "data-material", "data-density", "data-anchor"})
        if (node.attribute(name)) return true;
    return false;
}

bool isSvgLabel(const pugi::xml_node& node) {
    return hasSvgLabelAttributes(node) || readsAsLabel(svgObjectName(node), LabelForm::name);
}

void readSvgLabelName(const pugi::xml_node& node, FractureMap::Label& label,
                      std::vector<std::string>& problems) {
    const std::string name = svgObjectName(node);
    if (readsAsLabel(name, LabelForm::name)) return readLabelWords(name, label, problems);
    LabelWords reader(label, problems);
    if (node.attribute("data-name")) reader.set("name", trim(node.attribute("data-name").value()));
    reader.finish();
}

void readSvgLabelAttributes(const pugi::xml_node& node, FractureMap::Label& label,
                            std::vector<std::string>& problems) {
    LabelWords reader(label, problems);
    const std::string_view given = node.attribute("data-label").value();
    if (readsAsLabel(given, LabelForm::text))
        readLabelWords(given, label, problems);
    else if (!trim(given).empty())
        reader.set("name", trim(given));
    for (const std::string_view key :
         {"material", "density", "strength", "toughness", "anchor", "level"})
        if (const auto attribute = node.attribute(("data-" + std::string(key)).c_str()))
            reader.set(key, trim(attribute.value()));
    reader.finish();
}

SvgTextContent svgTextContent(const pugi::xml_node& text, const SvgViewport& viewport) {
    TextCollector collector(viewport);
    collector.visit(text, 0);
    return collector.take();
}

}  // namespace sherd
