// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "map/map_warnings.h"
#include "map/svg_line_style.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

/// What the reader brings home from a drawing, and what it passed over.
class SvgHarvest {
  public:
    SvgHarvest(std::string name, uint32_t level) : name_(std::move(name)), level_(level) {}

    /// "a.svg: path #crack3"
    std::string sourceOf(const pugi::xml_node& node) const;

    void warn(const pugi::xml_node& node, const std::string& problem);
    void warn(const pugi::xml_node& node, const std::vector<std::string>& problems);
    void passOver(std::string_view element) { ++ignored_[std::string(element)]; }
    void hide() { ++hidden_; }
    void stray(size_t shapes) { strays_ += shapes; }

    /// Lines of no extent are dropped.
    void addLine(std::vector<glm::dvec2> points, const pugi::xml_node& node,
                 const SvgLineStyle& style, const ColorLevels& colors);
    void addLabel(FractureMap::Label label, glm::dvec2 place, const pugi::xml_node& node);

    /// The map; an error if it holds no line.
    Result<FractureMap> finish();

  private:
    std::string passedOver() const;
    void reportIdleColors();

    std::string name_;
    uint32_t level_;
    FractureMap map_;
    MapWarnings warnings_;
    std::map<std::string, size_t> ignored_;
    std::map<uint32_t, size_t> idleColors_;  ///< lines in a colour that chooses no level
    size_t hidden_ = 0, strays_ = 0;
};

}  // namespace sherd
