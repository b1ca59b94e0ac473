// SPDX-License-Identifier: MIT
#include "solid/wall_crossings.h"

#include <algorithm>
#include <glm/common.hpp>

#include "solid/crossing.h"

namespace sherd {
namespace {

/// Shares of the diagonal: crossings less deep are rounding.
constexpr double kDeep = 1e-6;

using Corners = std::array<glm::vec3, 3>;

/// The triangles of walls, each with corners of its own.
struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> wallOf;

    void add(const SplitSurface& surface, const SolidWall& wall, std::span<const glm::vec3> hubs,
             uint32_t number) {
        for (const auto& t : wall.triangles) {
            const auto first = static_cast<uint32_t>(positions.size());
            for (const OutlineVertex& v : t)
                positions.push_back(v.hub != kNone ? hubs[v.hub] : surface.positions[v.vertex]);
            triangles.push_back({first, first + 1, first + 2});
            wallOf.push_back(number);
        }
    }
    Corners corners(size_t t) const {
        return {positions[3 * t], positions[3 * t + 1], positions[3 * t + 2]};
    }
};

std::array<glm::dvec3, 3> inDouble(const Corners& t) {
    return {t[0], t[1], t[2]};
}

/// All triangles of a tree that cross `triangle`.
template <class Visit>
void forEachCrossing(const TriangleBvh& tree, const Corners& triangle, double depth,
                     const Visit& visit) {
    const auto lowOf = [](const Corners& t) { return glm::min(glm::min(t[0], t[1]), t[2]); };
    const auto highOf = [](const Corners& t) { return glm::max(glm::max(t[0], t[1]), t[2]); };
    const glm::vec3 low = lowOf(triangle);
    const glm::vec3 high = highOf(triangle);
    const auto overlaps = [&](const glm::vec3& l, const glm::vec3& h) {
        return l.x <= high.x && h.x >= low.x && l.y <= high.y && h.y >= low.y && l.z <= high.z &&
               h.z >= low.z;
    };
    tree.forEach(overlaps, [&](uint32_t other, const Corners& corners) {
        if (overlaps(lowOf(corners), highOf(corners)) &&
            trianglesCross(inDouble(triangle), inDouble(corners), depth))
            visit(other);
    });
}

}  // namespace

WallCrossings::WallCrossings(const SplitSurface& surface)
    : surface_(surface),
      outer_(surface.positions, vertexTriangles(surface)),
      inside_(surface.positions, vertexTriangles(surface)),
      depth_(kDeep * boundsOf(surface).diagonal()) {}

bool WallCrossings::leaves(const SolidWall& wall, std::span<const glm::vec3> hubs) const {
    const auto at = [&](const OutlineVertex& v) {
        return glm::dvec3(v.hub != kNone ? hubs[v.hub] : surface_.positions[v.vertex]);
    };
    const auto isOut = [this](const glm::dvec3& p) {
        return !inside_.inside(p) && outer_.closest(p, depth_).triangle == ClosestPoint::kNone;
    };
    return std::any_of(wall.triangles.begin(), wall.triangles.end(), [&](const auto& t) {
        const glm::dvec3 a = at(t[0]), b = at(t[1]), c = at(t[2]);
        return isOut((a + b + c) / 3.0) || isOut(0.5 * (a + b)) || isOut(0.5 * (b + c)) ||
               isOut(0.5 * (c + a));
    });
}

bool WallCrossings::crosses(const SolidWall& wall, std::span<const glm::vec3> hubs) const {
    Soup soup;
    soup.add(surface_, wall, hubs, 0);
    const TriangleBvh inner(soup.positions, soup.triangles);
    bool found = false;
    for (size_t t = 0; t < soup.triangles.size() && !found; ++t) {
        forEachCrossing(outer_, soup.corners(t), depth_, [&](uint32_t) { found = true; });
        forEachCrossing(inner, soup.corners(t), depth_, [&](uint32_t) { found = true; });
    }
    return found;
}

void WallCrossings::markAmong(std::span<const SolidWall> walls, std::span<const glm::vec3> hubs,
                              std::vector<uint8_t>& broken) const {
    Soup soup;
    for (uint32_t w = 0; w < walls.size(); ++w) soup.add(surface_, walls[w], hubs, w);
    const TriangleBvh inner(soup.positions, soup.triangles);
    for (size_t t = 0; t < soup.triangles.size(); ++t) {
        forEachCrossing(inner, soup.corners(t), depth_, [&](uint32_t other) {
            for (const uint32_t w : {soup.wallOf[t], soup.wallOf[other]})
                broken[walls[w].low] = broken[walls[w].high] = 1;
        });
    }
}

}  // namespace sherd
