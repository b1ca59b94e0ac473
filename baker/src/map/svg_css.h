// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sherd {

/// The properties that decide whether, where and in which colour something is drawn.
enum class SvgProperty { display, visibility, opacity, transform, stroke, color };
inline constexpr size_t kSvgPropertyCount = 6;

/// What is said of an element itself; empty where nothing is.
class SvgStyle {
  public:
    const std::string& operator[](SvgProperty p) const { return values_[static_cast<size_t>(p)]; }
    std::string& operator[](SvgProperty p) { return values_[static_cast<size_t>(p)]; }

  private:
    std::array<std::string, kSvgPropertyCount> values_;
};

/// The part of CSS that decides these: rules whose selectors are a type, a class, an id, `*` or a
/// compound of these ("path.hidden"), in lists. Everything else (combinators, pseudo classes,
/// at-rules) is passed over.
class SvgStyleSheet {
  public:
    void add(std::string_view css);

    /// For each property: the node's style attribute, else the strongest rule, else the
    /// presentation attribute.
    SvgStyle styleOf(const pugi::xml_node& node) const;

    /// There were too many rules, or too much to compare them with: some were left out.
    bool overflowed() const { return overflowed_; }

  private:
    struct Selector {
        std::string type, id;
        std::vector<std::string> classes;
        size_t specificity() const {
            return (id.empty() ? 0 : 10000) + 100 * classes.size() + (type.empty() ? 0 : 1);
        }
    };
    struct Declaration {
        SvgProperty property;
        std::string value;
    };
    struct Rule {
        Selector selector;
        std::vector<Declaration> declarations;
    };
    struct Cascade;
    struct Subject;

    static std::vector<Declaration> parseDeclarations(std::string_view text);
    void addRule(std::string_view selectors, std::string_view declarations);
    static std::optional<Selector> parseSelector(std::string_view text);
    static std::string keyOf(const Selector& selector);
    static bool matches(const Selector& selector, const Subject& subject);
    void tryRules(const std::string& key, const Subject& subject, Cascade& cascade) const;

    std::vector<Rule> rules_;
    std::unordered_map<std::string, std::vector<size_t>> rulesOf_;  ///< by keyOf
    mutable size_t work_ = 0;
    mutable bool overflowed_ = false;
};

/// The name without its namespace prefix.
std::string_view localName(std::string_view name);

}  // namespace sherd
