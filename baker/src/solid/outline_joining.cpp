// SPDX-License-Identifier: MIT
#include "solid/outline_joining.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

namespace sherd {
namespace {

bool isRing(const WallPolygon& wall) {
    const auto& v = wall.outline.vertices;
    // Other outlines lead through the solid between the two ends of some arc.
    return std::all_of(v.begin(), v.end(), [](const OutlineVertex& x) { return x.onRing; });
}

/// Whether the solid lies within the ring: there the way inwards leads to its middle.
bool boundsDisc(const WallPolygon& wall) {
    glm::dvec3 middle(0.0);
    for (const PolygonCorner& corner : wall.corners) middle += corner.position;
    middle /= static_cast<double>(wall.corners.size());
    double inwards = 0;
    double length = 0;
    for (size_t i = 0; i < wall.corners.size(); ++i) {
        const PolygonCorner& corner = wall.corners[i];
        const PolygonCorner& next = wall.corners[(i + 1) % wall.corners.size()];
        const glm::dvec3 way = middle - corner.position;
        const double share = glm::distance(corner.position, next.position);
        const double distance = glm::length(way);
        length += share;
        if (distance > 0) inwards += share * glm::dot(corner.inwards, way) / distance;
    }
    constexpr double kMostlyInwards = 0.5;  // 60 degrees
    return inwards > kMostlyInwards * length;
}

struct Bridge {
    double length = std::numeric_limits<double>::infinity();
    size_t from = 0, to = 0;
};

using Allowed = std::function<bool(const OutlineVertex&, const OutlineVertex&)>;

Bridge shortestBridge(const WallPolygon& a, const WallPolygon& b, const Allowed& allowed) {
    Bridge best;
    for (size_t i = 0; i < a.corners.size(); ++i) {
        for (size_t j = 0; j < b.corners.size(); ++j) {
            const double length = glm::distance(a.corners[i].position, b.corners[j].position);
            if (!(length < best.length)) continue;
            if (!allowed(a.outline.vertices[i], b.outline.vertices[j])) continue;
            best = {length, i, j};
        }
    }
    return best;
}

/// Around a, over the bridge, around b, and back.
template <class Item>
std::vector<Item> spliced(std::vector<Item> a, std::vector<Item> b, const Bridge& bridge) {
    std::rotate(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(bridge.from), a.end());
    std::rotate(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(bridge.to), b.end());
    a.push_back(a.front());
    b.push_back(b.front());
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

}  // namespace

void joinOutlines(std::vector<WallPolygon>& walls, const Allowed& allowed,
                  std::vector<uint8_t>& broken) {
    std::map<std::pair<uint32_t, uint32_t>, std::vector<size_t>> ofPieces;
    for (size_t w = 0; w < walls.size(); ++w)
        ofPieces[{walls[w].outline.low, walls[w].outline.high}].push_back(w);
    std::vector<uint8_t> gone(walls.size(), 0);
    for (const auto& [pieces, members] : ofPieces) {
        for (const size_t w : members) {
            if (gone[w] != 0 || !isRing(walls[w]) || boundsDisc(walls[w])) continue;
            Bridge best;
            size_t partner = w;
            for (const size_t other : members) {
                if (other == w || gone[other] != 0) continue;
                const Bridge bridge = shortestBridge(walls[w], walls[other], allowed);
                if (!(bridge.length < best.length)) continue;
                best = bridge;
                partner = other;
            }
            if (partner == w) {
                broken[pieces.first] = broken[pieces.second] = 1;
                continue;
            }
            WallPolygon& other = walls[partner];
            other.outline.vertices =
                spliced(walls[w].outline.vertices, other.outline.vertices, best);
            other.corners = spliced(walls[w].corners, other.corners, best);
            gone[w] = 1;
            // What it has become is neither ring nor waits for another.
            for (OutlineVertex& vertex : other.outline.vertices) vertex.onRing = false;
        }
    }
    size_t kept = 0;
    for (size_t w = 0; w < walls.size(); ++w)
        if (gone[w] == 0) std::swap(walls[kept++], walls[w]);
    walls.resize(kept);
}

}  // namespace sherd
