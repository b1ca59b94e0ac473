// SPDX-License-Identifier: MIT
#include "map/svg_index.h"

#include "map/svg_names.h"
#include "map/svg_shapes.h"

namespace sherd {

namespace {

struct Indexer : pugi::xml_tree_walker {
    explicit Indexer(SvgIndex& index) : index_(index) {}
    bool for_each(pugi::xml_node& node) override {
        if (const pugi::xml_attribute id = node.attribute("id"))
            index_.ids.emplace(id.value(), node);
        if (localName(node.name()) == "style")
            for (const pugi::xml_node& text : node.children()) index_.styles.add(text.value());
        return true;
    }
    SvgIndex& index_;
};

struct StrayCounter : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
        if (isSvgShape(localName(node.name())) && !isSvgGuide(node)) ++strays;
        return true;
    }
    size_t strays = 0;
};

}  // namespace

SvgIndex::SvgIndex(const pugi::xml_node& root) {
    Indexer indexer(*this);
    pugi::xml_node(root).traverse(indexer);
}

pugi::xml_node SvgIndex::find(std::string_view href) const {
    if (href.empty() || href.front() != '#') return {};
    const auto found = ids.find(std::string(href.substr(1)));
    return found == ids.end() ? pugi::xml_node() : found->second;
}

size_t countStrayShapes(const pugi::xml_node& guide) {
    StrayCounter counter;
    pugi::xml_node(guide).traverse(counter);
    return counter.strays;
}

}  // namespace sherd
