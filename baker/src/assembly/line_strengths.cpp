// SPDX-License-Identifier: MIT
#include "assembly/line_strengths.h"

#include <algorithm>

namespace sherd {
namespace {

double mean(double length, double said, double sum, double otherwise) {
    return length > 0 ? (sum + (length - said) * otherwise) / length : otherwise;
}

}  // namespace

double BorderStrength::strengthOr(double otherwise) const {
    return mean(length, strengthLength, strength, otherwise);
}
double BorderStrength::toughnessOr(double otherwise) const {
    return mean(length, toughnessLength, toughness, otherwise);
}

BorderStrengths lineStrengths(const SplitSurface& surface, const MeshTopology& topology,
                              const LineTable& lines, const Components& components,
                              const Hierarchy& hierarchy) {
    BorderStrengths borders;
    bool anySaid = false;
    for (uint32_t mark = 1; mark <= lines.size(); ++mark) {
        const LineProperties& said = lines.line(mark).properties;
        anySaid = anySaid || said.strength || said.toughness;
    }
    if (!anySaid) return borders;
    const auto fragmentOf = [&](uint32_t triangle) {
        return hierarchy.fragmentOfRank[hierarchy.rankOfLeaf[components.leaf[triangle]]];
    };
    for (uint32_t h = 0; h < 3 * surface.triangles.size(); ++h) {
        const uint32_t o = topology.opposite[h];
        const uint32_t mark = surface.triangles[h / 3].line[h % 3];
        if (o == kNone || o < h || mark == 0) continue;
        const uint32_t a = fragmentOf(h / 3);
        const uint32_t b = fragmentOf(o / 3);
        if (a == b) continue;
        BorderStrength& border = borders[{std::min(a, b), std::max(a, b)}];
        const double length = edgeLength(surface, h);
        const LineProperties& said = lines.line(mark).properties;
        border.length += length;
        if (said.strength) {
            border.strengthLength += length;
            border.strength += length * double{*said.strength};
        }
        if (said.toughness) {
            border.toughnessLength += length;
            border.toughness += length * double{*said.toughness};
        }
    }
    std::erase_if(borders, [](const auto& item) {
        return item.second.strengthLength == 0 && item.second.toughnessLength == 0;
    });
    return borders;
}

}  // namespace sherd
