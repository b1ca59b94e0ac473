// SPDX-License-Identifier: MIT
#include "map/svg_harvest.h"

#include <algorithm>
#include <cmath>

#include "map/map_limits.h"
#include "map/map_text.h"
#include "map/svg_css.h"

namespace sherd {

std::string SvgHarvest::sourceOf(const pugi::xml_node& node) const {
    constexpr size_t kMaxId = 80;
    std::string source = name_ + ": " + std::string(localName(node.name()));
    if (const pugi::xml_attribute id = node.attribute("id"))
        return source + " #" + shortened(id.value(), kMaxId);
    return source + " at byte " + std::to_string(node.offset_debug());
}

void SvgHarvest::warn(const pugi::xml_node& node, const std::string& problem) {
    warnings_.add(sourceOf(node) + problem);
}

void SvgHarvest::warn(const pugi::xml_node& node, const std::vector<std::string>& problems) {
    for (const std::string& problem : problems) warn(node, ": " + problem);
}

void SvgHarvest::addLine(std::vector<glm::dvec2> points, const pugi::xml_node& node,
                         const SvgLineStyle& style, const ColorLevels& colors) {
    const bool extended = std::any_of(points.begin(), points.end(),
                                      [&](glm::dvec2 p) { return p != points.front(); });
    if (!extended) return;
    if (const auto color = style.idleColor(colors)) ++idleColors_[color->rgb];
    map_.lines.push_back(
        {std::move(points), style.level(colors), sourceOf(node), style.properties()});
}

void SvgHarvest::addLabel(FractureMap::Label label, glm::dvec2 place, const pugi::xml_node& node) {
    label.source = sourceOf(node);
    if (!std::isfinite(place.x) || !std::isfinite(place.y))
        return warn(node, ": the label is left out: it lies nowhere");
    if (map_.labels.size() >= kMaxMapLabels)
        return warnings_.add(name_ + ": labels beyond " + std::to_string(kMaxMapLabels) +
                             " are left out");
    label.place.point = {place, 0};
    map_.labels.push_back(std::move(label));
}

/// "2 hidden element(s), 1 text": what was not drawn, in a fixed order.
std::string SvgHarvest::passedOver() const {
    std::string list;
    const auto add = [&list](size_t count, const std::string& what) {
        if (count > 0) list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    };
    add(strays_, "shape(s) drawn in the guide layer (move them to a level layer)");
    add(hidden_, "hidden element(s)");
    for (const auto& [name, count] : ignored_) add(count, name);
    return list;
}

/// Where colours choose levels, a line in another colour may be a slip of the pen.
void SvgHarvest::reportIdleColors() {
    constexpr size_t kNamed = 5;
    if (idleColors_.empty()) return;
    std::string list;
    size_t lines = 0;
    size_t named = 0;
    for (const auto& [rgb, count] : idleColors_) {
        lines += count;
        if (named++ < kNamed) list += (list.empty() ? "" : ", ") + colorText(SvgColor{rgb});
    }
    warnings_.add(name_ + ": " + std::to_string(lines) +
                  " line(s) lie in no level's layer and have a colour that chooses no level (" +
                  list + (named > kNamed ? ", ..." : "") + "); they get level " +
                  std::to_string(level_));
}

Result<FractureMap> SvgHarvest::finish() {
    const std::string ignored = passedOver();
    if (map_.empty())
        return fail(ErrorCode::emptyMap,
                    "the drawing holds no line to break along" +
                        (ignored.empty() ? "" : " (passed over: " + ignored + ")") +
                        "; draw paths, lines or shapes, visible and outside the guide layer" +
                        (warnings_.all().empty() ? "" : ". " + warnings_.all().front()),
                    name_);
    reportIdleColors();
    map_.warnings = warnings_.take();
    if (!ignored.empty()) map_.warnings.push_back(name_ + ": passed over " + ignored);
    return std::move(map_);
}

}  // namespace sherd
