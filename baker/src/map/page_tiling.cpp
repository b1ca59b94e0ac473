// SPDX-License-Identifier: MIT
#include "map/page_tiling.h"

#include <algorithm>
#include <cmath>

#include "geometry/exact_grid.h"

namespace sherd {
namespace {

/// Where clamped lines end, in tiles: beyond every texture coordinate there can be.
constexpr double kFar = 8;

double toGrid(double x) {
    return std::abs(x) <= kFar ? static_cast<double>(std::llround(x * kGridOne)) / kGridOne : x;
}

/// What sticks out of the grid shows on nothing.
double placed(double x, Wrap wrap, int tile) {
    const double at = wrap == Wrap::mirror && tile % 2 != 0 ? tile + 1 - x : x + tile;
    return tile == 0 ? at : std::clamp(at, -kFar, kFar);
}

/// The lines cut off at the page's edges across one axis, and drawn on straight outwards.
TiledLines clampAxis(const TiledLines& from, int axis, int first, int last) {
    TiledLines to;
    const auto add = [&to](FractureMap::Line line, uint32_t of) {
        if (line.points.size() < 2) return;
        to.lines.push_back(std::move(line));
        to.lineOf.push_back(of);
    };
    for (size_t i = 0; i < from.lines.size(); ++i) {
        const FractureMap::Line& line = from.lines[i];
        FractureMap::Line inside{{}, line.level, line.source, line.properties};
        const auto finish = [&] {
            add(inside, from.lineOf[i]);
            inside.points.clear();
        };
        for (size_t p = 0; p < line.points.size(); ++p) {
            const glm::dvec2 here = line.points[p];
            if (p > 0) {
                const glm::dvec2 before = line.points[p - 1];
                std::vector<std::pair<double, double>> borders;  // place along, edge of the page
                for (const double edge : {0.0, 1.0}) {
                    const bool crosses = edge == 0.0 ? (before[axis] < 0) != (here[axis] < 0)
                                                     : (before[axis] > 1) != (here[axis] > 1);
                    if (!crosses) continue;
                    borders.emplace_back((edge - before[axis]) / (here[axis] - before[axis]), edge);
                }
                std::sort(borders.begin(), borders.end());
                for (const auto& [t, edge] : borders) {
                    glm::dvec2 at = before + (here - before) * t;
                    at[axis] = edge;
                    at[1 - axis] = toGrid(at[1 - axis]);
                    const bool wasInside = !inside.points.empty();
                    inside.points.push_back(at);
                    if (wasInside) finish();
                    if ((edge == 0 && first == 0) || (edge == 1 && last == 0)) continue;
                    glm::dvec2 far = at;
                    far[axis] = edge == 0 ? -kFar : kFar;
                    add({{at, far}, line.level, line.source, line.properties}, from.lineOf[i]);
                }
            }
            if (here[axis] >= 0 && here[axis] <= 1) inside.points.push_back(here);
        }
        finish();
    }
    return to;
}

}  // namespace

TiledLines tileLines(const std::vector<FractureMap::Line>& lines, Wrap wrapU, Wrap wrapV,
                     const TileRange& range) {
    TiledLines base;
    for (size_t i = 0; i < lines.size(); ++i) {
        base.lines.push_back(lines[i]);
        base.lineOf.push_back(static_cast<uint32_t>(i));
    }
    if (range.onlyPage()) return base;
    for (FractureMap::Line& line : base.lines)
        for (glm::dvec2& p : line.points) p = {toGrid(p.x), toGrid(p.y)};
    if (wrapU == Wrap::clamp) base = clampAxis(base, 0, range.firstU, range.lastU);
    if (wrapV == Wrap::clamp) base = clampAxis(base, 1, range.firstV, range.lastV);
    TiledLines all;
    TileRange tiles = range;
    if (wrapU == Wrap::clamp) tiles.firstU = tiles.lastU = 0;
    if (wrapV == Wrap::clamp) tiles.firstV = tiles.lastV = 0;
    for (int v = tiles.firstV; v <= tiles.lastV; ++v) {
        for (int u = tiles.firstU; u <= tiles.lastU; ++u) {
            for (size_t i = 0; i < base.lines.size(); ++i) {
                FractureMap::Line copy = base.lines[i];
                for (glm::dvec2& p : copy.points)
                    p = {placed(p.x, wrapU, u), placed(p.y, wrapV, v)};
                all.lines.push_back(std::move(copy));
                all.lineOf.push_back(base.lineOf[i]);
            }
        }
    }
    return all;
}

}  // namespace sherd
