// SPDX-License-Identifier: MIT
#include "appearance/hidden_edges.h"

#include <algorithm>
#include <tuple>

#include "geometry/triangle.h"

namespace sherd {
namespace {

struct HalfEdge {
    uint32_t high;     ///< the higher of its two vertices; the lower one says the bucket
    uint32_t id;       ///< 3 * face + k
    uint64_t surface;  ///< equal for faces of one surface
    bool upwards;      ///< from the lower vertex to the higher

    auto edge() const { return std::tie(high, surface); }
};

uint64_t surfaceOf(const HiddenMesh::Face& face) {
    return uint64_t{face.fragment} << 32 | uint64_t{face.exposedFrom} << 1 | (face.wall ? 1 : 0);
}

/// Half edges of one edge in one surface are glued in pairs, in their order where there are more.
void glue(std::vector<HalfEdge>& bucket, std::vector<uint32_t>& opposite) {
    std::sort(bucket.begin(), bucket.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tuple(a.edge(), a.id) < std::tuple(b.edge(), b.id);
    });
    for (size_t first = 0, last = 0; first < bucket.size(); first = last) {
        while (last < bucket.size() && bucket[last].edge() == bucket[first].edge()) ++last;
        size_t up = first, down = first;
        while (true) {
            while (up < last && !bucket[up].upwards) ++up;
            while (down < last && bucket[down].upwards) ++down;
            if (up == last || down == last) break;
            opposite[bucket[up].id] = bucket[down].id;
            opposite[bucket[down].id] = bucket[up].id;
            ++up;
            ++down;
        }
    }
}

}  // namespace

std::vector<uint32_t> hiddenOpposites(const HiddenMesh& mesh) {
    const auto count = static_cast<uint32_t>(3 * mesh.faces.size());
    const auto ends = [&](uint32_t h) {
        const auto& v = mesh.faces[h / 3].v;
        return std::minmax(v[h % 3], v[nextCorner(h) % 3]);
    };
    std::vector<uint32_t> start(mesh.positions.size() + 1, 0);
    for (uint32_t h = 0; h < count; ++h) ++start[ends(h).first + 1];
    for (size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
    std::vector<uint32_t> byLow(count);
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for (uint32_t h = 0; h < count; ++h) byLow[next[ends(h).first]++] = h;

    std::vector<uint32_t> opposite(count, kNone);
    std::vector<HalfEdge> bucket;
    for (size_t low = 0; low + 1 < start.size(); ++low) {
        bucket.clear();
        for (uint32_t i = start[low]; i < start[low + 1]; ++i) {
            const uint32_t h = byLow[i];
            const uint32_t high = ends(h).second;
            if (high == low) continue;
            bucket.push_back(
                {high, h, surfaceOf(mesh.faces[h / 3]), mesh.faces[h / 3].v[h % 3] == low});
        }
        glue(bucket, opposite);
    }
    return opposite;
}

}  // namespace sherd
