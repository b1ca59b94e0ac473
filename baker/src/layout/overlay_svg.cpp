// SPDX-License-Identifier: MIT
// Overlays as SVG: what became of lines drawn before, for the eye only.
#include "layout/overlay_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "layout/free_place.h"
#include "layout/svg_text.h"

namespace sherd {

namespace {

struct SpotKind {
    const char* code;
    const char* colour;
    const char* words;  ///< in the legend
};

constexpr std::array<SpotKind, 10> kSpotKinds = {{
    {"dead-ends", "#e6005c", "ends in the surface"},
    {"loose-ends", "#ff7f00", "ends at a chart border"},
    {"idle-lines", "#a07800", "separates nothing"},
    {"merged-small", "#0090e0", "component too small"},
    {"off-charts", "#606060", "outside every chart"},
    {"off-surface", "#8c564b", "off the surface"},
    {"gaps", "#8a2be2", "no way over the surface"},
    {"along-edges", "#00a0a0", "follows mesh edges"},
    {"closed-gaps", "#2ca02c", "gap that was closed"},
    {"", "#000000", "other"},
}};

constexpr std::array<const char*, 6> kLevelColours = {"#c00000", "#008030", "#0040c0",
                                                      "#a000a0", "#c06000", "#008090"};

const char* levelColour(uint32_t level) {
    return kLevelColours[(std::max(level, 1U) - 1) % kLevelColours.size()];
}

size_t kindOf(const std::string& code) {
    size_t k = 0;
    while (k + 1 < kSpotKinds.size() && code != kSpotKinds[k].code) ++k;
    return k;
}

struct Spot {
    glm::dvec2 at;
    std::string code;
    std::string title;
};

std::string titleOf(const BakeFinding& finding, const BakePlace& place) {
    std::string title = finding.code + ": " + finding.message;
    return place.note.empty() ? title : title + " [" + place.note + "]";
}

/// Each place once. What lies off the charts of one mesh may lie on those of another.
std::vector<Spot> spotsOf(std::span<const LayoutOverlay> overlays) {
    using Key = std::tuple<double, double, std::string>;
    std::map<Key, Spot> spots;
    std::map<Key, size_t> seen;
    for (const LayoutOverlay& overlay : overlays) {
        std::set<Key> here;
        for (const BakeFinding& finding : overlay.findings)
            for (const BakePlace& place : finding.places) {
                if (!place.uv || !std::isfinite(place.uv->x) || !std::isfinite(place.uv->y))
                    continue;
                Spot spot{*place.uv, finding.code, titleOf(finding, place)};
                const Key key{spot.at.x, spot.at.y, spot.title};
                if (here.insert(key).second) ++seen[key];
                spots.emplace(key, std::move(spot));
            }
    }
    std::vector<Spot> out;
    for (auto& [key, spot] : spots)
        if (spot.code != "off-charts" || seen[key] == overlays.size())
            out.push_back(std::move(spot));
    return out;
}

std::string linePath(const OverlayLine::Chains& chains, const std::string& style,
                     const std::string& title, double size, size_t& number) {
    std::string d;
    for (const std::vector<glm::dvec2>& chain : chains) addChain(chain, size, d);
    if (d.empty()) return {};
    return "    <path id=\"sherd-guide-line-" + std::to_string(++number) + "\" style=\"" + style +
           "\" d=\"" + d + "\"><title>" + escaped(title) + "</title></path>\n";
}

std::string lineStyle(uint32_t level, double unit, bool parting) {
    const std::string style =
        std::string("stroke:") + levelColour(level) + ";stroke-width:" + svgNumber(0.2 * unit);
    return parting ? style : style + ";stroke-dasharray:" + svgNumber(0.6 * unit);
}

std::string lineLayer(std::span<const LayoutOverlay> overlays, double size, double unit) {
    std::string content;
    size_t number = 0;
    for (const LayoutOverlay& overlay : overlays) {
        for (const OverlayLine& line : overlay.lines) {
            const std::string title = "level " + std::to_string(line.level) + ": " + line.source;
            content +=
                linePath(line.parting, lineStyle(line.level, unit, true), title, size, number);
            content += linePath(line.idle, lineStyle(line.level, unit, false),
                                title + " (separates nothing here)", size, number);
        }
    }
    if (content.empty()) return {};
    return guideLayer("sherd-guide-lines", "sherd guide lines",
                      "   <g id=\"sherd-guide-lines-style\" "
                      "style=\"fill:none;stroke-linejoin:round\">\n" +
                          content + "   </g>\n");
}

std::string ring(const std::string& id, const glm::dvec2& at, double unit, const char* colour,
                 const std::string& title) {
    std::string out = "    <circle id=\"" + id + "\" cx=\"" + svgNumber(at.x) + "\" cy=\"" +
                      svgNumber(at.y) + "\" r=\"" + svgNumber(0.8 * unit) +
                      "\" style=\"fill:" + colour + ";fill-opacity:0.15;stroke:" + colour +
                      ";stroke-width:" + svgNumber(0.2 * unit) + "\"";
    return out + (title.empty() ? "/>\n" : "><title>" + escaped(title) + "</title></circle>\n");
}

std::string spotLayer(const std::vector<Spot>& spots, double size, double unit) {
    std::string content;
    for (size_t i = 0; i < spots.size(); ++i)
        content += ring("sherd-guide-spot-" + std::to_string(i + 1), spots[i].at * size, unit,
                        kSpotKinds[kindOf(spots[i].code)].colour, spots[i].title);
    return content.empty() ? "" : guideLayer("sherd-guide-spots", "sherd guide spots", content);
}

/// One row of the legend: its sign is drawn around `at`, its words beside it.
struct LegendRow {
    std::string words;
    const char* colour;
    bool line;
    bool parting;
};

std::vector<LegendRow> legendRows(std::span<const LayoutOverlay> overlays,
                                  const std::vector<Spot>& spots) {
    std::set<uint32_t> levels;
    bool idle = false;
    for (const LayoutOverlay& overlay : overlays)
        for (const OverlayLine& line : overlay.lines) {
            levels.insert(line.level);
            idle = idle || !line.idle.empty();
        }
    std::vector<LegendRow> rows;
    rows.reserve(levels.size() + 1 + kSpotKinds.size());
    for (const uint32_t level : levels)
        rows.push_back({"level " + std::to_string(level), levelColour(level), true, true});
    if (idle) rows.push_back({"one piece on both sides", "#404040", true, false});
    std::array<size_t, kSpotKinds.size()> count{};
    for (const Spot& spot : spots) ++count[kindOf(spot.code)];
    for (size_t k = 0; k < kSpotKinds.size(); ++k)
        if (count[k] > 0)
            rows.push_back({kSpotKinds[k].words + (" (" + std::to_string(count[k]) + ")"),
                            kSpotKinds[k].colour, false, false});
    return rows;
}

std::string legendLayer(const std::vector<LegendRow>& rows, std::span<const SurfaceMesh> meshes,
                        double size, double unit) {
    if (rows.empty()) return {};
    size_t longest = 0;
    for (const LegendRow& row : rows) longest = std::max(longest, row.words.size());
    const glm::dvec2 extent((5 + 0.85 * static_cast<double>(longest)) * unit,
                            (1 + 2.2 * static_cast<double>(rows.size())) * unit);
    const glm::dvec2 corner = freePlace(meshes, extent / size) * size;
    std::string content = "    <rect id=\"sherd-guide-legend-back\" x=\"" + svgNumber(corner.x) +
                          "\" y=\"" + svgNumber(corner.y) + "\" width=\"" + svgNumber(extent.x) +
                          "\" height=\"" + svgNumber(extent.y) +
                          "\" style=\"fill:#ffffff;fill-opacity:0.85\"/>\n";
    for (size_t i = 0; i < rows.size(); ++i) {
        const LegendRow& row = rows[i];
        const std::string number = std::to_string(i + 1);
        const glm::dvec2 at = corner + glm::dvec2(2, 1.6 + 2.2 * static_cast<double>(i)) * unit;
        if (row.line)
            content += "    <path id=\"sherd-guide-legend-line-" + number + "\" d=\"M" +
                       svgNumber(at.x - 1.4 * unit) + " " + svgNumber(at.y) + " " +
                       svgNumber(at.x + 1.4 * unit) + " " + svgNumber(at.y) +
                       "\" style=\"fill:none;stroke:" + row.colour +
                       ";stroke-width:" + svgNumber(0.3 * unit) +
                       (row.parting ? "" : ";stroke-dasharray:" + svgNumber(0.6 * unit)) + "\"/>\n";
        else
            content += ring("sherd-guide-legend-ring-" + number, at, unit, row.colour, "");
        content += "    <text id=\"sherd-guide-legend-text-" + number + "\" x=\"" +
                   svgNumber(at.x + 2.2 * unit) + "\" y=\"" + svgNumber(at.y + 0.55 * unit) +
                   "\" style=\"font-family:sans-serif;font-size:" + svgNumber(1.6 * unit) +
                   "px;fill:#202020\">" + row.words + "</text>\n";
    }
    return guideLayer("sherd-guide-legend", "sherd guide legend", content);
}

}  // namespace

std::string guideLayer(const std::string& id, const std::string& label,
                       const std::string& content) {
    return "  <g id=\"" + id +
           "\" data-sherd-guide=\"true\" inkscape:groupmode=\"layer\"\n"
           "     inkscape:label=\"" +
           label + "\" sodipodi:insensitive=\"true\">\n" + content + "  </g>\n";
}

std::string overlayLayers(std::span<const LayoutOverlay> overlays,
                          std::span<const SurfaceMesh> meshes, double size, size_t& spots) {
    const double unit = size / 100;
    const std::vector<Spot> found = spotsOf(overlays);
    spots = found.size();
    return lineLayer(overlays, size, unit) + spotLayer(found, size, unit) +
           legendLayer(legendRows(overlays, found), meshes, size, 0.6 * unit);
}

}  // namespace sherd
