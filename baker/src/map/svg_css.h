// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sherd {

/// The part of CSS that decides whether something is drawn: rules whose selectors are a type, a
/// class, an id, `*` or a compound of these ("path.hidden"), in lists. Everything else
/// (combinators, pseudo classes, at-rules) is passed over.
class SvgStyleSheet {
  public:
    void add(std::string_view css);

    /// The value of `property` for `node`: its style attribute, else the strongest rule, else the
    /// presentation attribute; empty if nothing says.
    std::string property(const pugi::xml_node& node, const char* property) const;

  private:
    struct Selector {
        std::string type, id;
        std::vector<std::string> classes;
        size_t specificity() const {
            return (id.empty() ? 0 : 10000) + 100 * classes.size() + (type.empty() ? 0 : 1);
        }
    };
    struct Rule {
        Selector selector;
        std::string declarations;
    };

    void addRule(std::string_view selectors, std::string_view declarations);
    static std::optional<Selector> parseSelector(std::string_view text);
    static bool matches(const Selector& selector, const pugi::xml_node& node);

    std::vector<Rule> rules_;
};

/// The name without its namespace prefix.
std::string_view localName(std::string_view name);

}  // namespace sherd
