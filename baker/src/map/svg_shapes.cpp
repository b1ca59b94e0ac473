// SPDX-License-Identifier: MIT
#include "map/svg_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "map/svg_css.h"

namespace sherd {

namespace {

/// Reads an element's lengths and notes the first one that is none.
class Lengths {
  public:
    Lengths(const pugi::xml_node& node, const SvgViewport& viewport)
        : node_(node), viewport_(viewport) {}

    std::optional<double> optional(const char* name, double whole) {
        const pugi::xml_attribute attribute = node_.attribute(name);
        if (!attribute || std::string_view(attribute.value()) == "auto") return std::nullopt;
        const std::optional<double> value = parseSvgLength(attribute.value(), whole);
        if (!value && problem.empty())
            problem = "attribute " + std::string(name) + " is not a length";
        return value;
    }
    double x(const char* name) { return optional(name, viewport_.width).value_or(0); }
    double y(const char* name) { return optional(name, viewport_.height).value_or(0); }
    /// Lengths along neither axis are measured against the mean diagonal.
    double r(const char* name) {
        return optional(name, std::hypot(viewport_.width, viewport_.height) / std::sqrt(2.0))
            .value_or(0);
    }
    double width() const { return viewport_.width; }
    double height() const { return viewport_.height; }

    std::string problem;

  private:
    const pugi::xml_node& node_;
    const SvgViewport& viewport_;
};

void addEllipse(glm::dvec2 centre, double rx, double ry, SvgPath& path) {
    if (!(rx > 0) || !(ry > 0)) return;
    const glm::dvec2 right = centre + glm::dvec2(rx, 0);
    const glm::dvec2 left = centre - glm::dvec2(rx, 0);
    const ArcArguments arc{rx, ry, 0, false, true};
    path.outlines.push_back(
        {right, {arcPiece(right, arc, left), arcPiece(left, arc, right)}, true});
}

void addRect(Lengths& lengths, SvgPath& path) {
    const glm::dvec2 low(lengths.x("x"), lengths.y("y"));
    const glm::dvec2 size(lengths.x("width"), lengths.y("height"));
    if (!(size.x > 0) || !(size.y > 0)) return;
    const std::optional<double> givenX = lengths.optional("rx", lengths.width());
    const std::optional<double> givenY = lengths.optional("ry", lengths.height());
    const double rx = std::clamp(givenX.value_or(givenY.value_or(0)), 0.0, size.x / 2);
    const double ry = std::clamp(givenY.value_or(givenX.value_or(0)), 0.0, size.y / 2);
    const glm::dvec2 high = low + size;
    const bool round = rx > 0 && ry > 0;
    const glm::dvec2 r = round ? glm::dvec2(rx, ry) : glm::dvec2(0);
    // Clockwise: each side's start and end; a corner joins one side's end to the next one's start.
    const std::array<std::array<glm::dvec2, 2>, 4> sides = {
        {{{{low.x + r.x, low.y}, {high.x - r.x, low.y}}},
         {{{high.x, low.y + r.y}, {high.x, high.y - r.y}}},
         {{{high.x - r.x, high.y}, {low.x + r.x, high.y}}},
         {{{low.x, high.y - r.y}, {low.x, low.y + r.y}}}}};
    Outline outline{sides[0][0], {}, true};
    for (size_t k = 0; k < 4; ++k) {
        outline.pieces.push_back(linePiece(sides[k][1]));
        if (round)
            outline.pieces.push_back(
                arcPiece(sides[k][1], {rx, ry, 0, false, true}, sides[(k + 1) % 4][0]));
    }
    path.outlines.push_back(std::move(outline));
}

}  // namespace

bool isSvgShape(std::string_view name) {
    constexpr std::array<std::string_view, 7> kShapes = {"path", "line",   "polyline", "polygon",
                                                         "rect", "circle", "ellipse"};
    return std::find(kShapes.begin(), kShapes.end(), name) != kShapes.end();
}

double svgLength(const pugi::xml_node& node, const char* name, double whole, double fallback) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) return fallback;
    return parseSvgLength(attribute.value(), whole).value_or(fallback);
}

SvgPath svgShape(const pugi::xml_node& node, const SvgViewport& viewport) {
    const std::string_view name = localName(node.name());
    if (name == "path") return parseSvgPath(node.attribute("d").value());
    if (name == "polyline") return parseSvgPoints(node.attribute("points").value(), false);
    if (name == "polygon") return parseSvgPoints(node.attribute("points").value(), true);
    SvgPath path;
    Lengths lengths(node, viewport);
    if (name == "line") {
        const glm::dvec2 from(lengths.x("x1"), lengths.y("y1"));
        path.outlines.push_back({from, {linePiece({lengths.x("x2"), lengths.y("y2")})}, false});
    } else if (name == "rect") {
        addRect(lengths, path);
    } else if (name == "circle") {
        const double r = lengths.r("r");
        addEllipse({lengths.x("cx"), lengths.y("cy")}, r, r, path);
    } else if (name == "ellipse") {
        const std::optional<double> rx = lengths.optional("rx", viewport.width);
        const std::optional<double> ry = lengths.optional("ry", viewport.height);
        addEllipse({lengths.x("cx"), lengths.y("cy")}, rx.value_or(ry.value_or(0)),
                   ry.value_or(rx.value_or(0)), path);
    }
    path.problem = std::move(lengths.problem);
    if (!path.problem.empty()) path.outlines.clear();
    return path;
}

}  // namespace sherd
