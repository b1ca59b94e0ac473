// SPDX-License-Identifier: MIT
#include "map/page_tiling.h"

#include <algorithm>
#include <cmath>

#include "geometry/exact_grid.h"

namespace sherd {
namespace {

/// Where clamped lines end, in tiles: beyond every texture coordinate there can be.
constexpr double kFarthestTile = 8;

double toGrid(double x) {
    return std::abs(x) <= kFarthestTile ? static_cast<double>(std::llround(x * kGridOne)) / kGridOne
                                        : x;
}

double placed(double x, Wrap wrap, int tile) {
    return wrap == Wrap::mirror && tile % 2 != 0 ? tile + 1 - x : x + tile;
}

using Points = std::vector<glm::dvec2>;

/// The runs of a polyline between two bounds across an axis. What touches a bound ends or bends
/// exactly on it.
std::vector<Points> clip(const Points& points, int axis, double low, double high) {
    std::vector<Points> runs;
    Points run;
    const auto finish = [&] {
        if (run.size() > 1) runs.push_back(run);
        run.clear();
    };
    for (size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2& p = points[i - 1];
        const glm::dvec2& q = points[i];
        if (std::max(p[axis], q[axis]) < low || std::min(p[axis], q[axis]) > high) {
            finish();
            continue;
        }
        const auto bounded = [&](const glm::dvec2& end) {
            const double edge = std::clamp(end[axis], low, high);
            if (edge == end[axis]) return end;
            glm::dvec2 at = p + (q - p) * ((edge - p[axis]) / (q[axis] - p[axis]));
            at[axis] = edge;
            at[1 - axis] = toGrid(at[1 - axis]);
            return at;
        };
        const glm::dvec2 end = bounded(q);
        if (run.empty()) run.push_back(bounded(p));
        if (run.back() != end) run.push_back(end);
        if (end != q) finish();
    }
    finish();
    return runs;
}

/// The lines cut off at the page's edges across one axis, and from where they meet an edge drawn on
/// straight outwards. What only runs along an edge would cover all that is outside: it is not.
TiledLines clampAxis(const TiledLines& from, int axis, int first, int last) {
    TiledLines to;
    const auto add = [&to](Points points, const FractureMap::Line& line, uint32_t of) {
        to.lines.push_back({std::move(points), line.level, line.source, line.properties});
        to.lineOf.push_back(of);
    };
    for (size_t i = 0; i < from.lines.size(); ++i) {
        const FractureMap::Line& line = from.lines[i];
        for (Points& run : clip(line.points, axis, 0, 1)) {
            const auto meets = [&](size_t p, double edge) {
                return run[p][axis] == edge && ((p > 0 && run[p - 1][axis] != edge) ||
                                                (p + 1 < run.size() && run[p + 1][axis] != edge));
            };
            for (size_t p = 0; p < run.size(); ++p) {
                glm::dvec2 far = run[p];
                if (first < 0 && meets(p, 0)) {
                    far[axis] = -kFarthestTile;
                    add({run[p], far}, line, from.lineOf[i]);
                }
                if (last > 0 && meets(p, 1)) {
                    far[axis] = kFarthestTile;
                    add({run[p], far}, line, from.lineOf[i]);
                }
            }
            add(std::move(run), line, from.lineOf[i]);
        }
    }
    return to;
}

/// The line as a tile shows it. What sticks out of the grid shows on nothing and is cut off.
std::vector<Points> copyOf(const Points& points, Wrap wrapU, int u, Wrap wrapV, int v) {
    std::vector<Points> copies(1);
    for (const glm::dvec2& p : points)
        copies[0].emplace_back(placed(p.x, wrapU, u), placed(p.y, wrapV, v));
    for (int axis = 0; axis < 2; ++axis) {
        // The page itself is not cut: lines beyond the grid are refused where they are planarised.
        if ((axis == 0 ? u : v) == 0) continue;
        std::vector<Points> within;
        for (const Points& copy : copies)
            for (Points& run : clip(copy, axis, -kFarthestTile, kFarthestTile))
                within.push_back(std::move(run));
        copies = std::move(within);
    }
    return copies;
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
                const FractureMap::Line& line = base.lines[i];
                for (Points& points : copyOf(line.points, wrapU, u, wrapV, v)) {
                    all.lines.push_back(
                        {std::move(points), line.level, line.source, line.properties});
                    all.lineOf.push_back(base.lineOf[i]);
                }
            }
        }
    }
    return all;
}

}  // namespace sherd
