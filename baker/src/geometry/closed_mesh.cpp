// SPDX-License-Identifier: MIT
#include "geometry/closed_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <vector>

#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "geometry/weld.h"

namespace sherd {
namespace {

struct DirectedEdge {
    uint64_t key;  ///< low id << 32 | high id
    uint32_t corner;
    bool forward;
};

/// Edges sorted by key with a counting sort on the low id.
std::vector<DirectedEdge> sortedEdges(std::span<const std::array<uint32_t, 3>> triangles) {
    uint32_t idCount = 0;
    for (const auto& t : triangles) idCount = std::max({idCount, t[0] + 1, t[1] + 1, t[2] + 1});
    std::vector<uint32_t> start(size_t{idCount} + 1, 0);
    for (const auto& t : triangles) {
        for (size_t k = 0; k < 3; ++k) ++start[std::min(t[k], t[(k + 1) % 3]) + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<DirectedEdge> edges(triangles.size() * 3);
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = triangles[i][k];
            const uint32_t b = triangles[i][(k + 1) % 3];
            const uint32_t low = std::min(a, b);
            edges[next[low]++] = {uint64_t{low} << 32 | std::max(a, b), 3 * i + k, a < b};
        }
    }
    for (size_t v = 0; v < idCount; ++v) {
        std::sort(edges.begin() + start[v], edges.begin() + start[v + 1],
                  [](const DirectedEdge& a, const DirectedEdge& b) {
                      return std::tie(a.key, a.corner) < std::tie(b.key, b.corner);
                  });
    }
    return edges;
}

uint64_t mixed(uint64_t x) {  // SplitMix64
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ x >> 27) * 0x94d049bb133111ebULL;
    return x ^ x >> 31;
}

}  // namespace

ClosedReport proveByIds(std::span<const std::array<uint32_t, 3>> triangles) {
    ClosedReport report;
    const std::vector<DirectedEdge> edges = sortedEdges(triangles);
    UnionFind fan(triangles.size() * 3);  // corners around a vertex, joined over edges
    for (size_t i = 0; i < edges.size();) {
        size_t end = i;
        size_t forward = 0;
        while (end < edges.size() && edges[end].key == edges[i].key)
            forward += edges[end++].forward ? 1 : 0;
        const size_t backward = end - i - forward;
        if (forward != backward) {
            report.openEdges +=
                static_cast<uint32_t>(forward > backward ? forward - backward : backward - forward);
        } else if (forward > 1) {
            ++report.repeatedEdges;
        } else {
            fan.unite(edges[i].corner, nextCorner(edges[i + 1].corner));
            fan.unite(nextCorner(edges[i].corner), edges[i + 1].corner);
        }
        i = end;
    }
    if (report.openEdges != 0 || report.repeatedEdges != 0) return report;
    std::vector<std::pair<uint32_t, uint32_t>> fans;  // vertex, fan
    fans.reserve(triangles.size() * 3);
    for (uint32_t c = 0; c < triangles.size() * 3; ++c)
        fans.emplace_back(triangles[c / 3][c % 3], fan.find(c));
    std::sort(fans.begin(), fans.end());
    fans.erase(std::unique(fans.begin(), fans.end()), fans.end());
    for (size_t i = 1; i < fans.size(); ++i)
        report.splitFans += fans[i].first == fans[i - 1].first ? 1 : 0;
    return report;
}

bool edgesCancel(std::span<const std::array<uint32_t, 3>> triangles) {
    uint64_t sum = 0;
    for (const auto& t : triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const uint64_t a = t[k], b = t[(k + 1) % 3];
            if (a < b) sum += mixed(a << 32 | b);
            if (b < a) sum -= mixed(b << 32 | a);
        }
    }
    return sum == 0;
}

ClosedReport proveByPositions(std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles) {
    std::vector<glm::vec3> corners;
    corners.reserve(triangles.size() * 3);
    for (const auto& t : triangles) {
        for (const uint32_t v : t) corners.push_back(positions[v]);
    }
    std::vector<glm::vec3> distinct;
    const std::vector<uint32_t> ids = PositionWelder(distinct).add(corners);
    std::vector<std::array<uint32_t, 3>> welded;
    welded.reserve(triangles.size());
    for (size_t i = 0; i < ids.size(); i += 3) {
        const std::array<uint32_t, 3> w{ids[i], ids[i + 1], ids[i + 2]};
        if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) welded.push_back(w);
    }
    ClosedReport report;
    report.openEdges = proveByIds(welded).openEdges;
    return report;
}

double signedVolume(std::span<const glm::vec3> positions,
                    std::span<const std::array<uint32_t, 3>> triangles, const glm::dvec3& origin) {
    double six = 0;
    for (const auto& t : triangles) {
        const glm::dvec3 a = glm::dvec3(positions[t[0]]) - origin;
        const glm::dvec3 b = glm::dvec3(positions[t[1]]) - origin;
        const glm::dvec3 c = glm::dvec3(positions[t[2]]) - origin;
        six += glm::dot(a, glm::cross(b, c));
    }
    return six / 6;
}

}  // namespace sherd
