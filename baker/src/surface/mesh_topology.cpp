// SPDX-License-Identifier: MIT
#include "surface/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace sherd {
namespace {

struct Use {
    uint64_t key;  ///< low << 32 | high
    uint32_t halfEdge;
    bool forward;  ///< runs low -> high
};

/// Direction of the triangle beside the half edge, perpendicular to it.
glm::dvec3 apexDirection(std::span<const glm::vec3> positions,
                         const std::array<uint32_t, 3>& triangle, uint32_t k,
                         const glm::dvec3& origin, const glm::dvec3& axis) {
    const glm::dvec3 apex = glm::dvec3(positions[triangle[(k + 2) % 3]]) - origin;
    return apex - axis * glm::dot(apex, axis);
}

/// Pairs the uses of one edge: every forward one with the backward one reached first when turning
/// from it through the inside of the solid. Only which valid pairing is taken depends on floating
/// point, so closedness never does.
void pairUses(std::span<const glm::vec3> positions,
              std::span<const std::array<uint32_t, 3>> triangles, std::span<const Use> uses,
              std::vector<uint32_t>& opposite) {
    const auto low = static_cast<uint32_t>(uses[0].key >> 32);
    const auto high = static_cast<uint32_t>(uses[0].key);
    const glm::dvec3 origin = positions[low];
    const glm::dvec3 along = glm::dvec3(positions[high]) - origin;
    const double length = glm::length(along);
    const glm::dvec3 axis = length > 0 ? along / length : glm::dvec3(1, 0, 0);
    struct Candidate {
        double angle;
        uint32_t forward, backward;
        bool operator<(const Candidate& o) const {
            return std::tie(angle, forward, backward) < std::tie(o.angle, o.forward, o.backward);
        }
    };
    std::vector<Candidate> candidates;
    for (const Use& f : uses) {
        if (!f.forward) continue;
        const glm::dvec3 x =
            apexDirection(positions, triangles[f.halfEdge / 3], f.halfEdge % 3, origin, axis);
        const glm::dvec3 y = glm::cross(axis, x);
        for (const Use& b : uses) {
            if (b.forward) continue;
            const glm::dvec3 d =
                apexDirection(positions, triangles[b.halfEdge / 3], b.halfEdge % 3, origin, axis);
            // The face beside a forward half edge has its normal axis x apex, so inside is turning
            // against it, from -y.
            double angle = std::atan2(-glm::dot(d, y), glm::dot(d, x));
            if (angle <= 0) angle += 2 * M_PI;
            candidates.push_back({angle, f.halfEdge, b.halfEdge});
        }
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& c : candidates) {
        if (opposite[c.forward] != kNone || opposite[c.backward] != kNone) continue;
        opposite[c.forward] = c.backward;
        opposite[c.backward] = c.forward;
    }
}

std::vector<Use> collectUses(std::span<const std::array<uint32_t, 3>> triangles,
                             std::vector<uint8_t>& degenerate) {
    std::vector<Use> uses;
    uses.reserve(triangles.size() * 3);
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const auto& v = triangles[t];
        degenerate[t] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        if (degenerate[t]) continue;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = v[k];
            const uint32_t b = v[(k + 1) % 3];
            const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
            uses.push_back({key, 3 * t + k, a < b});
        }
    }
    return uses;
}

/// Sorts by edge with a counting sort on the low vertex: linear, and stable in the half edge.
void sortByEdge(std::vector<Use>& uses, size_t vertexCount) {
    std::vector<uint32_t> start(vertexCount + 1, 0);
    for (const Use& use : uses) ++start[(use.key >> 32) + 1];
    for (size_t v = 0; v < vertexCount; ++v) start[v + 1] += start[v];
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    std::vector<Use> sorted(uses.size());
    for (const Use& use : uses) sorted[next[use.key >> 32]++] = use;
    for (size_t v = 0; v < vertexCount; ++v) {
        std::sort(sorted.begin() + start[v], sorted.begin() + start[v + 1],
                  [](const Use& a, const Use& b) {
                      return a.key != b.key ? a.key < b.key : a.halfEdge < b.halfEdge;
                  });
    }
    uses = std::move(sorted);
}

}  // namespace

MeshTopology buildTopology(std::span<const glm::vec3> positions,
                           std::span<const std::array<uint32_t, 3>> triangles) {
    MeshTopology topology;
    topology.degenerate.assign(triangles.size(), 0);
    topology.halfEdgeEdge.assign(triangles.size() * 3, kNone);
    topology.opposite.assign(triangles.size() * 3, kNone);
    std::vector<Use> uses = collectUses(triangles, topology.degenerate);
    sortByEdge(uses, positions.size());

    for (size_t i = 0; i < uses.size();) {
        size_t end = i;
        uint32_t forward = 0;
        while (end < uses.size() && uses[end].key == uses[i].key) forward += uses[end++].forward;
        const auto count = static_cast<uint32_t>(end - i);
        const auto edge = static_cast<uint32_t>(topology.edges.size());
        topology.edges.push_back(
            {static_cast<uint32_t>(uses[i].key >> 32), static_cast<uint32_t>(uses[i].key)});
        for (size_t u = i; u < end; ++u) topology.halfEdgeEdge[uses[u].halfEdge] = edge;

        if (count == 2 && forward == 1) {
            topology.opposite[uses[i].halfEdge] = uses[i + 1].halfEdge;
            topology.opposite[uses[i + 1].halfEdge] = uses[i].halfEdge;
        } else if (count == 1) {
            ++topology.boundaryEdges;
            if (topology.firstBoundaryHalfEdge == kNone) {
                topology.firstBoundaryHalfEdge = uses[i].halfEdge;
            }
        } else {
            if (2 * forward == count) {
                ++topology.pinchedEdges;
            } else {
                ++topology.nonManifoldEdges;
                if (topology.firstNonManifoldHalfEdge == kNone) {
                    topology.firstNonManifoldHalfEdge = uses[i].halfEdge;
                }
            }
            pairUses(positions, triangles, std::span(uses).subspan(i, count), topology.opposite);
        }
        i = end;
    }
    return topology;
}

}  // namespace sherd
